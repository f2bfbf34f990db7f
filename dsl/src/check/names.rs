//! The language's own names, which nothing that an author declares may hide.

use setpiece_scenario::vocabulary::{
    EventKind, Function, Owner, PROPERTIES, PitchRegion, Property, Type, ValueWord,
};

/// Names of values that are no properties.
pub(crate) fn values() -> impl Iterator<Item = &'static str> {
    ValueWord::NAMES.iter().chain(PitchRegion::NAMES).copied()
}

/// The property of the match that a name stands for.
pub(crate) fn match_property(name: &str) -> Option<&'static Property> {
    debug_assert!(PROPERTIES.iter().all(|property| property.ty != Type::Behavior));
    PROPERTIES.iter().find(|property| property.owner == Owner::Match && property.name == name)
}

/// Whether a name means something wherever a value stands.
pub(crate) fn is_value(name: &str) -> bool {
    values().any(|value| value == name) || match_property(name).is_some()
}

/// What a word belongs to that a value can't be called.
pub(crate) fn owner_of_value(name: &str) -> Option<&'static str> {
    match name {
        _ if EventKind::from_name(name).is_some() => Some("events"),
        _ if is_value(name) => Some("the language"),
        _ => None,
    }
}

/// What a word belongs to that something to be called, `name(…)`, can't be called.
pub(crate) fn owner_of_call(name: &str) -> Option<&'static str> {
    Function::from_name(name).map(|_| "functions")
}
