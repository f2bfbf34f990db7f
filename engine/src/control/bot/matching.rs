//! Matches players to places so that the longest way is short, and among such matchings the total
//! of the ways is least. (GRF's.)

use arrayvec::ArrayVec;
use setpiece_scenario::pitch::TEAM_MAX;

/// Distances in decimetres, from each player (row) to each place.
pub(super) type Ways = [[i32; TEAM_MAX]; TEAM_MAX];
/// The place of each player.
pub(super) type Places = [usize; TEAM_MAX];

/// No player, or no place.
const NONE: usize = TEAM_MAX;
/// A distance too long to count.
const TOO_LONG: i32 = 1 << 20;
/// The search for the longest way goes in leaps of this many distances, so the result may exceed
/// the minimum by that many. (GRF's.)
const LEAP: usize = 5;

/// Computes the matching of the first `count` players and places.
pub(super) fn matching(ways: &Ways, count: usize) -> Places {
    let limit = limit(ways, count);
    let mut allowed = *ways;
    for way in allowed.as_flattened_mut() {
        *way = if *way >= limit { TOO_LONG } else { *way };
    }
    shortest(&allowed, count)
}

/// The distance below which all ways of a matching can lie, searched in leaps.
fn limit(ways: &Ways, count: usize) -> i32 {
    let mut all: ArrayVec<i32, { TEAM_MAX * TEAM_MAX }> = ArrayVec::new();
    let (mut of_player, mut of_place) = ([i32::MAX; TEAM_MAX], [i32::MAX; TEAM_MAX]);
    for (player, row) in ways[..count].iter().enumerate() {
        all.extend(row[..count].iter().copied());
        for (place, &way) in row[..count].iter().enumerate() {
            of_player[player] = of_player[player].min(way);
            of_place[place] = of_place[place].min(way);
        }
    }
    // No limit is below a player's shortest way, or a place's. It is rarely much above, so the
    // search begins there, with short leaps.
    let least = of_player[..count].iter().chain(&of_place[..count]).fold(0, |a, b| a.max(*b));
    let shorter = all.iter().filter(|way| **way <= least).count();
    let leaps = all.len().saturating_sub(count).div_ceil(LEAP);
    let mut low = shorter.saturating_sub(count).div_ceil(LEAP).min(leaps);
    let (mut high, mut leap) = (leaps, 0);
    // Only the distances that are looked at come to their sorted places, in `open` those between
    // the last two.
    let mut open = 0..all.len();
    let mut limit = TOO_LONG;
    while low < high {
        let next = (low + leap).min(usize::midpoint(low, high));
        let at = count + next * LEAP;
        let (_, &mut way, _) = all[open.clone()].select_nth_unstable(at - open.start);
        if is_possible(ways, count, way) {
            (high, open.end, limit) = (next, at, way);
        } else {
            (low, open.start, leap) = (next + 1, at + 1, 2 * leap + 1);
        }
    }
    limit
}

/// Whether everyone finds a place with ways below a limit.
fn is_possible(ways: &Ways, count: usize, limit: i32) -> bool {
    let mut near = [0u32; TEAM_MAX];
    for (near, row) in near.iter_mut().zip(&ways[..count]) {
        *near = row[..count]
            .iter()
            .enumerate()
            .fold(0, |near, (place, way)| near | u32::from(*way < limit) << place);
    }
    let (mut whose, mut free) = ([NONE; TEAM_MAX], (1 << count) - 1);
    (0..count).all(|player| finds_place(&near, &mut whose, &mut free, player, &mut 0))
}

/// Whether a player finds a place, if others move on where they can.
fn finds_place(
    near: &[u32; TEAM_MAX],
    whose: &mut [usize; TEAM_MAX],
    free: &mut u32,
    player: usize,
    seen: &mut u32,
) -> bool {
    let found = near[player] & *free;
    if found != 0 {
        let place = found.trailing_zeros() as usize;
        *free &= !(1 << place);
        whose[place] = player;
        return true;
    }
    loop {
        let open = near[player] & !*seen;
        if open == 0 {
            return false;
        }
        let place = open.trailing_zeros() as usize;
        *seen |= 1 << place;
        if finds_place(near, whose, free, whose[place], seen) {
            whose[place] = player;
            return true;
        }
    }
}

/// The matching with the least total distance: the Hungarian method, one shortest augmenting path
/// per player.
fn shortest(ways: &Ways, count: usize) -> Places {
    let mut price = [0i32; TEAM_MAX];
    // One more than there are players, for places without a player.
    let mut gain = [0i32; TEAM_MAX + 1];
    // The place of each player, and the player of each place.
    let mut places = [NONE; TEAM_MAX];
    let mut whose = [NONE; TEAM_MAX];
    for player in 0..count {
        // The least distance of a path to each place, the place before it, and whether it may still
        // change. Written without branches, because nobody can predict which place is nearer.
        let mut least = [i32::MAX; TEAM_MAX];
        let mut from = [NONE; TEAM_MAX];
        let mut open = [true; TEAM_MAX];
        open[count..].fill(false);
        let (mut mover, mut at, mut path) = (player, NONE, 0);
        let end = loop {
            let row = &ways[mover];
            let base = path - gain[mover];
            let (mut step, mut next) = (i32::MAX, 0);
            for place in 0..TEAM_MAX {
                let way = base + row[place] - price[place];
                let nearer = open[place] && way < least[place];
                least[place] = if nearer { way } else { least[place] };
                from[place] = if nearer { at } else { from[place] };
                let found = open[place] && least[place] < step;
                step = if found { least[place] } else { step };
                next = if found { place } else { next };
            }
            path = step;
            (at, open[next]) = (next, false);
            if whose[at] == NONE {
                break at;
            }
            mover = whose[at];
        };
        // Players on shorter paths than this one gain what their places become cheaper.
        gain[player] += path;
        for place in 0..count {
            let gains = if open[place] { 0 } else { path - least[place] };
            gain[whose[place]] += gains;
            price[place] -= gains;
        }
        let mut place = end;
        while place != NONE {
            let before = from[place];
            let mover = if before == NONE { player } else { whose[before] };
            (whose[place], places[mover]) = (mover, place);
            place = before;
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All matchings of `count`.
    fn all(count: usize) -> Vec<Vec<usize>> {
        if count == 0 {
            return vec![Vec::new()];
        }
        let add = |rest: Vec<usize>| {
            (0..count).map(move |at| [&rest[..at], &[count - 1], &rest[at..]].concat())
        };
        all(count - 1).into_iter().flat_map(add).collect()
    }

    #[test]
    fn the_longest_way_is_short_and_the_sum_the_least_of_those() {
        let mut seed = 1u32;
        let mut roll = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) as i32 % 900
        };
        for round in 0..300 {
            let count = 1 + round % 6;
            let mut ways = [[0; TEAM_MAX]; TEAM_MAX];
            ways.iter_mut().flatten().for_each(|way| *way = roll());
            let limit = limit(&ways, count);
            let found = matching(&ways, count);
            let sum = |places: &[usize]| {
                places.iter().enumerate().map(|(player, place)| ways[player][*place]).sum::<i32>()
            };
            let fits = |places: &[usize]| {
                places.iter().enumerate().all(|(player, place)| ways[player][*place] < limit)
            };
            let best = all(count)
                .into_iter()
                .filter(|places| fits(places))
                .map(|places| sum(&places))
                .min();
            assert!(fits(&found[..count]), "{count}: {found:?}");
            assert_eq!(Some(sum(&found[..count])), best);
        }
    }

    #[test]
    fn the_limit_is_the_first_leap_at_which_everyone_finds_a_place() {
        let mut seed = 7u32;
        for round in 0..2000 {
            let count = round % (TEAM_MAX + 1);
            let mut ways = [[0; TEAM_MAX]; TEAM_MAX];
            for way in ways.as_flattened_mut() {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                *way = (seed >> 16) as i32 % 300;
            }
            let mut sorted = ways[..count].iter().flat_map(|row| &row[..count]).collect::<Vec<_>>();
            sorted.sort_unstable();
            let mut leaps = sorted.iter().skip(count).step_by(LEAP);
            let first = leaps.find(|way| is_possible(&ways, count, ***way));
            assert_eq!(limit(&ways, count), first.map_or(TOO_LONG, |way| **way), "{count}");
        }
    }

    #[test]
    fn two_short_ways_are_taken_before_a_long_and_none() {
        let mut ways = [[0; TEAM_MAX]; TEAM_MAX];
        (ways[0][0], ways[0][1], ways[1][0], ways[1][1]) = (0, 50, 50, 120);
        // A total of 120 with one long way, or 100 with two of 50.
        assert_eq!(matching(&ways, 2)[..2], [1, 0]);
    }
}
