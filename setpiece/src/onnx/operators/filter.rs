//! Operators with a window that moves over pictures `(batch, channels, height, width)`.

use super::linear::add_product;
use crate::onnx::node::NodeInputs;
use crate::onnx::tensor::{Tensor, size_of};

/// A window and how it moves.
struct FilterWindow {
    /// Height and width.
    size: [usize; 2],
    steps: [usize; 2],
    /// How far apart the pixels in it are.
    gaps: [usize; 2],
    /// Added at the top and on the left.
    before: [usize; 2],
    /// The height and width of what comes out.
    out: [usize; 2],
}

impl FilterWindow {
    fn of(
        given: &NodeInputs<'_>,
        size: [usize; 2],
        picture: [usize; 2],
    ) -> Result<FilterWindow, String> {
        let pair = |name: &str| -> Result<[usize; 2], String> {
            let Some(given) = given.attributes.integers(name) else { return Ok([1, 1]) };
            let read = |&it: &i64| usize::try_from(it).ok().filter(|&it| it > 0);
            let read: Option<Vec<usize>> = given.iter().map(read).collect();
            read.and_then(|it| it.try_into().ok()).ok_or(format!("`{name}` isn't of a picture"))
        };
        let (steps, gaps) = (pair("strides")?, pair("dilations")?);
        if !matches!(given.attributes.text("auto_pad"), "" | "NOTSET" | "VALID") {
            return Err("`auto_pad` isn't known: export it with numbers".to_owned());
        }
        let pads = given.attributes.integers("pads").unwrap_or(&[0; 4]);
        let pads: Option<Vec<usize>> = pads.iter().map(|&it| usize::try_from(it).ok()).collect();
        let pads: Option<[usize; 4]> = pads.and_then(|it| it.try_into().ok());
        let [top, left, bottom, right] = pads.ok_or("`pads` aren't of a picture")?;
        let after = [bottom, right];
        let before = [top, left];
        let mut out = [0; 2];
        for axis in 0..2 {
            let reach =
                (size[axis].max(1) - 1).checked_mul(gaps[axis]).and_then(|it| it.checked_add(1));
            let whole =
                picture[axis].checked_add(before[axis]).and_then(|it| it.checked_add(after[axis]));
            if reach.is_none_or(|reach| before[axis] >= reach || after[axis] >= reach) {
                return Err("`pads` are as large as the window".to_owned());
            }
            let room = whole.zip(reach).and_then(|(whole, reach)| whole.checked_sub(reach));
            let room = room.ok_or("the window is larger than the picture")?;
            out[axis] = room / steps[axis] + 1;
        }
        Ok(FilterWindow { size, steps, gaps, before, out })
    }

    /// The place in the picture of a pixel of the window, unless it is outside.
    fn place(&self, out: [usize; 2], within: [usize; 2], picture: [usize; 2]) -> Option<usize> {
        let at = |axis: usize| {
            let along = out[axis] * self.steps[axis] + within[axis] * self.gaps[axis];
            along.checked_sub(self.before[axis]).filter(|&at| at < picture[axis])
        };
        Some(at(0)? * picture[1] + at(1)?)
    }

    /// Everything that the window shows of a channel: a row for each of its pixels.
    fn shown(&self, channel: &[f32], picture: [usize; 2], rows: &mut Vec<f32>) {
        for y in 0..self.size[0] {
            for x in 0..self.size[1] {
                for down in 0..self.out[0] {
                    rows.extend((0..self.out[1]).map(|across| {
                        self.place([down, across], [y, x], picture).map_or(0.0, |at| channel[at])
                    }));
                }
            }
        }
    }
}

fn pictures(tensor: &Tensor) -> Result<[usize; 4], String> {
    let shape = &tensor.shape;
    let four: Result<[usize; 4], _> = shape[..].try_into();
    let four = four.map_err(|_| format!("expected pictures, found {shape:?}"))?;
    if four.contains(&0) { Err(format!("the pictures {shape:?} are empty")) } else { Ok(four) }
}

/// Filters pictures; the second input has a filter per channel that comes out.
pub(super) fn conv(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let (seen, filters) = (given.input(0)?, given.input(1)?);
    let ([batch, channels, height, width], [filters_n, depth, high, wide]) =
        (pictures(seen)?, pictures(filters)?);
    let groups = usize::try_from(given.attributes.integer("group", 1)).unwrap_or(0);
    if groups == 0 || depth.checked_mul(groups) != Some(channels) || filters_n % groups != 0 {
        return Err(format!("{:?} filtered by {:?} don't fit", seen.shape, filters.shape));
    }
    let (picture, per_group) = ([height, width], filters_n / groups);
    let window = FilterWindow::of(given, [high, wide], picture)?;
    let (pixels, inner) = (size_of(&window.out)?, depth * high * wide);
    size_of(&[inner, pixels])?;
    let mut out = Vec::with_capacity(size_of(&[batch, filters_n, pixels])?);
    let bias = given.optional(2).map(Tensor::as_floats).transpose()?;
    let (seen, weights) = (seen.as_floats()?, filters.as_floats()?);
    let mut rows = Vec::with_capacity(inner * pixels);
    for one in seen.chunks_exact(channels * picture[0] * picture[1]) {
        for (group, channels) in one.chunks_exact(depth * picture[0] * picture[1]).enumerate() {
            rows.clear();
            for channel in channels.chunks_exact(picture[0] * picture[1]) {
                window.shown(channel, picture, &mut rows);
            }
            let (from, first) = (out.len(), group * per_group);
            for filter in first..first + per_group {
                let begin = bias.and_then(|bias| bias.get(filter)).copied().unwrap_or_default();
                out.extend(std::iter::repeat_n(begin, pixels));
            }
            let weights = &weights[first * inner..(first + per_group) * inner];
            add_product(&mut out[from..], weights, &rows, inner, pixels);
        }
    }
    Ok(Tensor::floats([batch, filters_n, window.out[0], window.out[1]], out))
}

/// The greatest number that the window shows.
pub(super) fn max_pool(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let seen = given.input(0)?;
    let [batch, channels, height, width] = pictures(seen)?;
    let size: Option<Vec<usize>> = given.attributes.integers("kernel_shape").and_then(|size| {
        size.iter().map(|&it| usize::try_from(it).ok().filter(|&it| it > 0)).collect()
    });
    let size = size.and_then(|it| it.try_into().ok()).ok_or("`kernel_shape` isn't of a picture")?;
    if given.attributes.integer("ceil_mode", 0) != 0 {
        return Err("`ceil_mode` isn't known".to_owned());
    }
    let picture = [height, width];
    let window = FilterWindow::of(given, size, picture)?;
    let mut out = Vec::with_capacity(size_of(&[batch, channels, window.out[0], window.out[1]])?);
    for channel in seen.as_floats()?.chunks_exact(height * width) {
        for down in 0..window.out[0] {
            for across in 0..window.out[1] {
                let within = (0..size[0]).flat_map(|y| (0..size[1]).map(move |x| [y, x]));
                let places = within.filter_map(|it| window.place([down, across], it, picture));
                out.push(places.fold(f32::NEG_INFINITY, |most, at| most.max(channel[at])));
            }
        }
    }
    Ok(Tensor::floats([batch, channels, window.out[0], window.out[1]], out))
}
