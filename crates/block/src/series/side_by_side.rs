//! The series of several motions of one block, side by side in vectors.

use uplift_instructions::{FEW, Numbers};
use uplift_taylor::{LEAST_ORDER, TRUNCATION};

use super::{INVERSE, Series};
use crate::block::RockingBlock;
use crate::sine::{sine_and_cosine, sines_and_cosines};

/// Motions side by side.
pub(crate) const LANES: usize = FEW;

/// A number of each.
pub(crate) type Lanes = [f64; LANES];

/// Highest power in the series of a velocity: 5 to 10 suffice for most sample intervals of a record, 13 for nearly all.
const MOST: usize = 14;

/// What the series of a block share.
#[derive(Debug)]
pub(crate) struct Constants {
    slenderness_rad: f64,
    tangent: f64,
    cosine: f64,
    minus_p_squared: f64,
}

impl Constants {
    pub(crate) fn new(block: &RockingBlock) -> Self {
        let slenderness_rad = block.slenderness_rad();
        let (sine, cosine) = sine_and_cosine(slenderness_rad);
        let minus_p_squared = -block.frequency_parameter_rad_s().powi(2);
        Self { slenderness_rad, tangent: sine / cosine, cosine, minus_p_squared }
    }
}

/// A step, and what shakes the block on it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    /// Ground acceleration in units of g and in the frame of the corner: at the begin, and its change.
    pub(crate) ground: [f64; 2],
    pub(crate) length_s: f64,
}

impl Step {
    /// One that takes no time.
    pub(crate) const NONE: Self = Self { ground: [0.0; 2], length_s: 0.0 };
}

/// What steps begin with, and what shakes the block on them.
#[derive(Debug)]
pub(crate) struct Begins {
    pub(crate) x: Lanes,
    pub(crate) v: Lanes,
    /// Ground acceleration in units of g and in the frame of the corner: at the begin, and its change.
    pub(crate) ground: [Lanes; 2],
    pub(crate) length_s: Lanes,
}

impl Begins {
    /// Of steps that take no time.
    pub(crate) const NONE: Self =
        Self { x: [0.0; LANES], v: [0.0; LANES], ground: [[0.0; LANES]; 2], length_s: [0.0; LANES] };

    pub(crate) fn put(&mut self, lane: usize, (x, v): (f64, f64), step: &Step) {
        (self.x[lane], self.v[lane], self.length_s[lane]) = (x, v, step.length_s);
        (self.ground[0][lane], self.ground[1][lane]) = (step.ground[0], step.ground[1]);
    }

    pub(crate) fn clear(&mut self, lane: usize) {
        self.put(lane, (0.0, 0.0), &Step::NONE);
    }
}

/// The [series](Series) of a step of each motion. Beyond the order of its own, that of a motion is zero.
pub(crate) struct SeriesOfAll<N: Numbers<LANES>> {
    numbers: N,
    x: [N::F64s; MOST + 2],
    v: [N::F64s; MOST + 1],
    sine: [N::F64s; MOST + 1],
    cosine: [N::F64s; MOST + 1],
    /// The order of each, and 1 of those that need a higher one than there is, 0 of others.
    orders: N::F64s,
    open: N::F64s,
    /// The highest of all.
    order: usize,
}

/// What comes of the series, and what bounds it on the step.
pub(crate) struct Outcome<V> {
    /// Rotation and velocity at the end.
    pub(crate) x: V,
    pub(crate) v: V,
    /// x₁ and Σ |xₖ|.
    pub(crate) first: V,
    pub(crate) reach: V,
    /// v₁, Σ |vₖ| from k = 1 on, and Σ k |vₖ| from k = 2 on.
    pub(crate) acceleration: V,
    pub(crate) change: V,
    pub(crate) bend: V,
    /// 1 of those that need a higher order than there is, 0 of others.
    pub(crate) open: V,
}

impl<N: Numbers<LANES>> SeriesOfAll<N> {
    #[inline(always)]
    pub(crate) fn new(numbers: N) -> Self {
        let zero = numbers.splat(0.0);
        let (x, v, sine, cosine) = ([zero; MOST + 2], [zero; MOST + 1], [zero; MOST + 1], [zero; MOST + 1]);
        Self { numbers, x, v, sine, cosine, orders: zero, open: zero, order: 0 }
    }

    /// Makes them those of the steps of `begins`.
    #[inline(always)]
    pub(crate) fn expand(&mut self, constants: &Constants, begins: &Begins) -> Outcome<N::F64s> {
        let n = self.numbers;
        let [x, v, begin, change, length_s] =
            [&begins.x, &begins.v, &begins.ground[0], &begins.ground[1], &begins.length_s].map(|own| n.load(own));
        let (sine, cosine) = sines_and_cosines(n, n.sub(n.splat(constants.slenderness_rad), x));
        [self.x[0], self.v[0], self.sine[0], self.cosine[0]] = [x, v, sine, cosine];
        let (zero, speed) = (n.splat(0.0), n.abs(v));
        // as a difference of tangents the moment vanishes exactly at uplift
        let at_corner = n.mul(n.splat(constants.cosine), n.add(n.splat(constants.tangent), begin));
        let moment = n.if_at_most(x, zero, at_corner, n.add(sine, n.mul(begin, cosine)));
        let mut growing = Growing {
            series: self,
            length_s,
            minus_p_squared: n.splat(constants.minus_p_squared),
            ground: [begin, change],
            moment,
            largest: speed,
            reach: n.abs(x),
            change: zero,
            bend: zero,
        };
        growing.grow();
        let Growing { reach, change, bend, .. } = growing;
        let last = n.mul(n.mul(length_s, n.splat(INVERSE[self.order])), self.v[self.order]);
        self.x[self.order + 1] = last;
        let end = |terms: &[N::F64s]| terms.iter().rev().copied().reduce(|sum, term| n.add(sum, term)).unwrap_or(zero);
        let (x, v) = (end(&self.x[..self.order + 2]), end(&self.v[..=self.order]));
        Outcome {
            x,
            v,
            first: self.x[1],
            reach: n.add(reach, n.abs(last)),
            acceleration: self.v[1],
            change,
            bend,
            open: self.open,
        }
    }

    /// Writes that of a lane, of a step of `length_s`, into `series`; false if it needs a higher order.
    pub(crate) fn write(&self, lane: usize, length_s: f64, series: &mut Series) -> bool {
        let n = self.numbers;
        let of_lane = |numbers: &N::F64s| n.number(numbers, lane);
        if of_lane(&self.open) != 0.0 {
            return false;
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number
        let order = of_lane(&self.orders) as usize;
        (series.step_s, series.order) = (length_s, order);
        for (own, of_all) in series.x[..order + 2].iter_mut().zip(&self.x) {
            *own = of_lane(of_all);
        }
        for (own, of_all) in series.v[..=order].iter_mut().zip(&self.v) {
            *own = of_lane(of_all);
        }
        true
    }
}

/// Series on their way to higher orders.
struct Growing<'a, N: Numbers<LANES>> {
    series: &'a mut SeriesOfAll<N>,
    length_s: N::F64s,
    minus_p_squared: N::F64s,
    ground: [N::F64s; 2],
    /// Coefficient of the moment in the power that is reached.
    moment: N::F64s,
    /// The largest coefficient of the velocity.
    largest: N::F64s,
    reach: N::F64s,
    change: N::F64s,
    bend: N::F64s,
}

impl<N: Numbers<LANES>> Growing<'_, N> {
    #[inline(always)]
    fn grow(&mut self) {
        let n = self.series.numbers;
        (self.series.open, self.series.orders) = (n.splat(1.0), n.splat(LEAST_ORDER as f64));
        self.next::<0>();
        self.next::<1>();
        self.next::<2>();
        let _ = self.next::<3>()
            || self.next::<4>()
            || self.next::<5>()
            || self.next::<6>()
            || self.next::<7>()
            || self.next::<8>()
            || self.next::<9>()
            || self.next::<10>()
            || self.next::<11>()
            || self.next::<12>()
            || self.next::<13>();
    }

    /// From the power `K` to the next, operation by operation as in [`Series::expand`]; whether no series needs more.
    /// As a constant, `K` leaves no loop, and the coefficients in registers.
    #[inline(always)]
    fn next<const K: usize>(&mut self) -> bool {
        let SeriesOfAll { numbers: n, x, v, sine, cosine, orders, open, order } = &mut *self.series;
        let n = *n;
        let zero = n.splat(0.0);
        let of_rate = n.mul(self.length_s, n.splat(INVERSE[K]));
        let next = n.mul(n.mul(self.minus_p_squared, of_rate), self.moment);
        v[K + 1] = if K < LEAST_ORDER { next } else { n.if_at_most(*open, zero, zero, next) };
        x[K + 1] = n.mul(of_rate, v[K]);
        // sums that do not begin at zero, and the sign last: a shorter chain, and only the signs of zeros differ
        let (mut falls, mut rises) = (n.mul(cosine[0], v[K]), n.mul(sine[0], v[K]));
        for j in 1..=K {
            falls = n.add(falls, n.mul(cosine[j], v[K - j]));
            rises = n.add(rises, n.mul(sine[j], v[K - j]));
        }
        sine[K + 1] = n.mul(n.mul(self.length_s, n.splat(-INVERSE[K])), falls);
        cosine[K + 1] = n.mul(of_rate, rises);
        let push = n.add(n.mul(self.ground[0], cosine[K + 1]), n.mul(self.ground[1], cosine[K]));
        self.moment = n.add(sine[K + 1], push);
        let size = n.abs(v[K + 1]);
        self.largest = n.larger(size, self.largest);
        self.reach = n.add(self.reach, n.abs(x[K + 1]));
        self.change = n.add(self.change, size);
        if K > 0 {
            self.bend = n.add(self.bend, n.mul(n.splat((K + 1) as f64), size));
        }
        *order = K + 1;
        if K + 1 < LEAST_ORDER {
            return false;
        }
        let tail = n.larger(size, n.abs(v[K]));
        *open = n.if_at_most(tail, n.mul(n.splat(TRUNCATION), self.largest), zero, *open);
        *orders = n.add(*orders, *open);
        // asked at every other order: the branch is hard to predict
        K % 2 == 1 && n.at_most(*open, zero) == (1 << LANES) - 1
    }
}
