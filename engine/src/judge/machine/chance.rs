//! What a program draws.

use super::Machine;
use crate::random::Stream;
use setpiece_scenario::{Distribution, Reg};

impl<const W: usize> Machine<'_, W> {
    /// Draws from the stream of a key; the distribution's registers have their current values.
    pub fn draw(&self, key: u64, from: &Distribution) -> f64 {
        let Some(draws) = self.draws else { return f64::NAN };
        let random = &mut Stream::of_draw(draws.seed, draws.index, draws.attempt, key);
        let value = |reg: &Reg| self.regs[reg.index()][0];
        match from {
            Distribution::Uniform(low, high) => {
                let (low, high) = (value(low), value(high));
                low + (high - low) * random.unit_f64()
            }
            Distribution::Normal(mean, sd) => value(mean) + value(sd) * random.normal(),
            Distribution::TruncatedNormal(mean, sd, low, high) => {
                random.truncated_normal(value(mean), value(sd), value(low), value(high))
            }
            Distribution::Integer(low, high) => {
                let (low, high) = (libm::ceil(value(low)), libm::floor(value(high)));
                if low <= high {
                    (low + libm::floor(random.unit_f64() * (high - low + 1.0))).min(high)
                } else {
                    f64::NAN
                }
            }
            Distribution::Weighted(weights) => {
                let weight = |reg: &Reg| value(reg).max(0.0);
                let total: f64 = weights.iter().map(weight).sum();
                let mut left = random.unit_f64() * total;
                let mut chosen = f64::NAN;
                for (index, reg) in weights.iter().enumerate() {
                    if weight(reg) > 0.0 {
                        chosen = index as f64;
                        left -= weight(reg);
                        if left < 0.0 {
                            break;
                        }
                    }
                }
                chosen
            }
        }
    }
}
