//! Chooses the moments of an episode worth a frame: its start and end, what happened, and enough in
//! between.

/// The most frames of a sheet, and the least if the episode is long enough.
pub const FRAMES_MAX: usize = 24;
const FRAMES_LEAST: usize = 12;
/// Events within this many moments share a frame…
const CLOSE: usize = 3;
/// … up to this many in all.
const LONG: usize = 9;

/// An event at a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Happening {
    /// The moment.
    pub at: usize,
    /// Its importance; events of weight 0 get no frame.
    pub weight: u32,
}

/// Chooses among this many moments, in order: the first, the last, the most important ones, then
/// evenly in between until the last row of columns is full.
pub fn choose(moments: usize, happenings: &[Happening], columns: usize) -> Vec<usize> {
    let Some(last) = moments.checked_sub(1) else { return Vec::new() };
    let mut chosen = vec![0, last];
    chosen.dedup();
    let mut groups = grouped(happenings);
    while chosen.len() < FRAMES_MAX {
        // Among equals, the one farthest from the moments already chosen.
        let far = |group: &Happening| {
            chosen.iter().map(|at| at.abs_diff(group.at)).min().unwrap_or_default()
        };
        groups.retain(|group| far(group) >= CLOSE);
        let Some(best) = groups.iter().max_by_key(|group| (group.weight, far(group))).copied()
        else {
            break;
        };
        chosen.push(best.at);
    }
    chosen.sort_unstable();
    fill(&mut chosen, columns);
    chosen
}

/// Groups events that are close in time. A group is shown at its most important moment, the last
/// among equals.
fn grouped(happenings: &[Happening]) -> Vec<Happening> {
    let mut groups: Vec<(usize, usize, Happening)> = Vec::new();
    for happening in happenings.iter().filter(|happening| happening.weight > 0) {
        match groups.last_mut() {
            Some((first, last, group))
                if happening.at - *last <= CLOSE && happening.at - *first <= LONG =>
            {
                *last = happening.at;
                if happening.weight >= group.weight {
                    *group = *happening;
                }
            }
            _ => groups.push((happening.at, happening.at, *happening)),
        }
    }
    groups.into_iter().map(|(_, _, group)| group).collect()
}

/// Halves the widest gaps until the last row is full.
fn fill(chosen: &mut Vec<usize>, columns: usize) {
    let wanted = chosen.len().max(FRAMES_LEAST).next_multiple_of(columns.max(1));
    while chosen.len() < wanted {
        let widest = chosen.windows(2).enumerate().map(|(index, pair)| (pair[1] - pair[0], index));
        // The first of equals, so that ties are resolved from the start.
        let Some((gap, index)) = widest.max_by_key(|&(gap, index)| (gap, usize::MAX - index))
        else {
            break;
        };
        if gap < 2 {
            break;
        }
        chosen.insert(index + 1, chosen[index] + gap / 2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(at: usize, weight: u32) -> Happening {
        Happening { at, weight }
    }

    #[test]
    fn an_episode_without_events_is_shown_evenly() {
        let chosen = choose(111, &[], 4);
        assert_eq!((chosen.len(), chosen[0], chosen[11]), (12, 0, 110));
        let gaps: Vec<usize> = chosen.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(gaps.iter().all(|gap| (6..=14).contains(gap)), "{gaps:?}");
    }

    #[test]
    fn a_short_episode_shows_every_moment_once() {
        assert_eq!(choose(5, &[at(2, 100), at(3, 10)], 4), [0, 1, 2, 3, 4]);
        assert_eq!(choose(1, &[], 4), [0]);
        assert_eq!(choose(0, &[], 4), [] as [usize; 0]);
    }

    #[test]
    fn what_is_close_in_time_shares_the_frame_that_matters_most() {
        let chosen = choose(200, &[at(50, 10), at(52, 70), at(54, 8), at(90, 10)], 4);
        assert!(chosen.contains(&52) && chosen.contains(&90), "{chosen:?}");
        assert!(!chosen.contains(&50) && !chosen.contains(&54), "{chosen:?}");
    }

    #[test]
    fn of_equals_the_last_is_shown() {
        assert!(choose(200, &[at(50, 20), at(52, 20)], 4).contains(&52));
    }

    #[test]
    fn a_long_match_shows_what_matters_most() {
        let mut happenings: Vec<Happening> = (1..300).map(|k| at(k * 10, 10)).collect();
        happenings.extend([at(1234, 100), at(2468, 70)]);
        happenings.sort_by_key(|happening| happening.at);
        let chosen = choose(3001, &happenings, 4);
        assert_eq!(chosen.len(), FRAMES_MAX);
        assert!(chosen.contains(&1234) && chosen.contains(&2468), "{chosen:?}");
        assert!(chosen.windows(2).all(|pair| pair[0] < pair[1]), "{chosen:?}");
        // The rest is spread over the match.
        assert!(chosen.windows(2).all(|pair| pair[1] - pair[0] < 400), "{chosen:?}");
    }

    #[test]
    fn a_row_is_filled() {
        let happenings: Vec<Happening> = (1..14).map(|k| at(k * 20, 30)).collect();
        assert_eq!([4, 5, 6].map(|columns| choose(400, &happenings, columns).len()), [16, 15, 18]);
    }
}
