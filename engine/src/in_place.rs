//! Copying into existing buffers: they keep their memory, so that a copy of an episode allocates
//! nothing.

/// Implements `Clone` field by field; `clone_from` copies every field into its place.
macro_rules! clone_in_place {
    ($type:ident $(<const $w:ident: usize>)? { $($field:ident),+ $(,)? }) => {
        impl $(<const $w: usize>)? Clone for $type $(<$w>)? {
            fn clone(&self) -> Self {
                let Self { $($field),+ } = self;
                Self { $($field: $field.clone()),+ }
            }

            fn clone_from(&mut self, from: &Self) {
                let Self { $($field),+ } = from;
                $(self.$field.clone_from($field);)+
            }
        }
    };
}

pub(crate) use clone_in_place;
