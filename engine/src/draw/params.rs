//! Draws a scenario's parameters from what they may be.

use crate::random::{Purpose, Stream};
use setpiece_scenario::vocabulary::Type;
use setpiece_scenario::{Bindings, Param};

/// Drawn values are whole multiples of one of so many parts, SI units.
const PARTS: f64 = 1e4;

/// Draws every parameter that has a range, a list of values or words to choose from, and those that
/// are `on` or `off`; the others keep their value.
///
/// Each value is uniform over what is allowed. The result depends on the seed and the index alone.
pub fn draw_params(params: &[Param], bindings: &Bindings, seed: u64, index: u64) -> Bindings {
    let mut stream = Stream::new(seed, index, Purpose::Params);
    let values = params.iter().zip(&bindings.0);
    Bindings(values.map(|(param, &value)| draw(param, value, &mut stream)).collect())
}

/// Changes some parameters a little: a value with a range by a normal step of `scale` times its
/// width, another with a chance of `scale` to any that is allowed. `varied` are the places of those
/// that may change.
pub fn mutate_params(
    params: &[Param],
    bindings: &Bindings,
    varied: &[usize],
    scale: f64,
    stream: &mut Stream,
) -> Bindings {
    let mut changed = bindings.clone();
    for &at in varied {
        let (Some(param), Some(value)) = (params.get(at), changed.0.get_mut(at)) else { continue };
        *value = match param.range {
            Some((low, high)) if param.values.is_empty() => {
                let moved = *value + scale * (high - low) * stream.normal();
                let parts = if param.ty == Type::Int { 1.0 } else { PARTS };
                ((moved * parts).round() / parts).clamp(low, high)
            }
            _ if stream.unit_f64() < scale => draw(param, *value, stream),
            _ => *value,
        };
    }
    changed
}

fn draw(param: &Param, value: f64, stream: &mut Stream) -> f64 {
    if !param.values.is_empty() {
        let index = stream.below(param.values.len() as u32) as usize;
        return param.values.get(index).copied().unwrap_or(value);
    }
    if !param.choices.is_empty() {
        return f64::from(stream.below(param.choices.len() as u32));
    }
    match (param.ty, param.range) {
        (Type::Bool, _) => f64::from(stream.below(2)),
        (Type::Int, Some((low, high))) if high - low < f64::from(u32::MAX) => {
            low + f64::from(stream.below((high - low) as u32 + 1))
        }
        (_, Some((low, high))) => {
            let drawn = low + (high - low) * stream.unit_f64();
            // Few decimals, so that a level is short as text.
            ((drawn * PARTS).round() / PARTS).clamp(low, high)
        }
        (_, None) => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn param(ty: Type, range: Option<(f64, f64)>, values: &[f64], choices: &[&str]) -> Param {
        Param {
            name: "p".to_owned(),
            doc: String::new(),
            ty,
            default: 0.0,
            range,
            choices: choices.iter().map(|&choice| choice.to_owned()).collect(),
            values: values.to_vec(),
        }
    }

    #[test]
    fn every_value_is_allowed_and_every_end_is_reached() {
        let params = [
            param(Type::Length, Some((2.0, 5.0)), &[], &[]),
            param(Type::Int, Some((1.0, 3.0)), &[], &[]),
            param(Type::Number, None, &[0.5, 0.9], &[]),
            param(Type::String, None, &[], &["a", "b", "c"]),
            param(Type::Bool, None, &[], &[]),
            param(Type::Number, None, &[], &[]),
        ];
        let start = Bindings(vec![2.0, 1.0, 0.5, 0.0, 0.0, 7.0]);
        let drawn: Vec<Bindings> =
            (0..400).map(|index| draw_params(&params, &start, 3, index)).collect();
        for bindings in &drawn {
            for (param, value) in params.iter().zip(&bindings.0) {
                assert_eq!(param.admit(*value).as_ref(), Ok(value), "{param:?}");
            }
        }
        for (at, ends) in [(1, [1.0, 3.0]), (2, [0.5, 0.9]), (3, [0.0, 2.0]), (4, [0.0, 1.0])] {
            for end in ends {
                assert!(drawn.iter().any(|bindings| bindings.0[at] == end), "{at}: {end}");
            }
        }
        assert!(drawn.iter().all(|bindings| bindings.0[5] == 7.0), "it has no range");
        assert_eq!(drawn[8], draw_params(&params, &start, 3, 8));
    }
}
