//! Matches players to places so that the longest way is short, and among such matchings the total
//! of the ways is least. (GRF's.)

use setpiece_scenario::pitch::TEAM_MAX;

/// Distances in decimetres, from each player (row) to each place.
pub(super) type Ways = [[i32; TEAM_MAX]; TEAM_MAX];
/// The place of each player.
pub(super) type Places = [usize; TEAM_MAX];

/// A distance too long to count.
const TOO_LONG: i32 = 1 << 20;
/// The search for the longest way goes in leaps of this many distances, so the result may exceed
/// the minimum by that many. (GRF's.)
const LEAP: usize = 5;

/// Computes the matching of the first `count` players and places.
pub(super) fn matching(ways: &Ways, count: usize) -> Places {
    let limit = limit(ways, count);
    let mut allowed = *ways;
    for way in allowed[..count].iter_mut().flat_map(|row| &mut row[..count]) {
        if *way >= limit {
            *way = TOO_LONG;
        }
    }
    shortest(&allowed, count)
}

/// The distance below which all ways of a matching can lie, searched in leaps.
fn limit(ways: &Ways, count: usize) -> i32 {
    let mut sorted = [0i32; TEAM_MAX * TEAM_MAX];
    let all = count * count;
    for (kept, way) in sorted.iter_mut().zip(ways[..count].iter().flat_map(|row| &row[..count])) {
        *kept = *way;
    }
    sorted[..all].sort_unstable();
    let leaps = all.saturating_sub(count).div_ceil(LEAP);
    let (mut low, mut high) = (0, leaps);
    while low < high {
        let middle = usize::midpoint(low, high);
        if is_possible(ways, count, sorted[count + middle * LEAP]) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    if low == leaps { TOO_LONG } else { sorted[count + low * LEAP] }
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
    let mut whose = [usize::MAX; TEAM_MAX];
    (0..count).all(|player| finds_place(&near, &mut whose, player, &mut 0))
}

/// Whether a player finds a place, if others move on where they can.
fn finds_place(
    near: &[u32; TEAM_MAX],
    whose: &mut [usize; TEAM_MAX],
    player: usize,
    seen: &mut u32,
) -> bool {
    loop {
        let open = near[player] & !*seen;
        if open == 0 {
            return false;
        }
        let place = open.trailing_zeros() as usize;
        *seen |= 1 << place;
        if whose[place] == usize::MAX || finds_place(near, whose, whose[place], seen) {
            whose[place] = player;
            return true;
        }
    }
}

/// The matching with the least total distance: the Hungarian method, one shortest augmenting path
/// per player.
fn shortest(ways: &Ways, count: usize) -> Places {
    const NOBODY: usize = TEAM_MAX;
    let mut price = [0i32; TEAM_MAX + 1];
    let mut gain = [0i32; TEAM_MAX + 1];
    let mut whose = [NOBODY; TEAM_MAX + 1];
    for player in 0..count {
        // The place beyond the last represents the player who has none yet.
        let mut at = TEAM_MAX;
        whose[at] = player;
        let mut least = [i32::MAX; TEAM_MAX];
        let mut from = [TEAM_MAX; TEAM_MAX];
        let mut done = 0u32;
        while whose[at] != NOBODY {
            done |= 1 << at;
            let mover = whose[at];
            let (mut step, mut next) = (i32::MAX, 0);
            for place in (0..count).filter(|place| done & (1 << place) == 0) {
                let way = ways[mover][place] - gain[mover] - price[place];
                if way < least[place] {
                    (least[place], from[place]) = (way, at);
                }
                if least[place] < step {
                    (step, next) = (least[place], place);
                }
            }
            for place in (0..count).chain([TEAM_MAX]) {
                if done & (1 << place) != 0 {
                    gain[whose[place]] += step;
                    price[place] -= step;
                } else {
                    least[place] -= step;
                }
            }
            at = next;
        }
        while at != TEAM_MAX {
            whose[at] = whose[from[at]];
            at = from[at];
        }
    }
    let mut places = [0; TEAM_MAX];
    for (place, &player) in whose[..count].iter().enumerate() {
        places[player] = place;
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
    fn two_short_ways_are_taken_before_a_long_and_none() {
        let mut ways = [[0; TEAM_MAX]; TEAM_MAX];
        (ways[0][0], ways[0][1], ways[1][0], ways[1][1]) = (0, 50, 50, 120);
        // A total of 120 with one long way, or 100 with two of 50.
        assert_eq!(matching(&ways, 2)[..2], [1, 0]);
    }
}
