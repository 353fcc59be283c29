//! The plotting area: from positions to pixels, and what lies inside.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use std::ops::Range;

/// The points that have positions, in runs without a gap.
pub(super) fn runs<P, T>(points: &[P], position: impl Fn(&P) -> Option<T>) -> Vec<Vec<T>> {
    let mut runs = Vec::new();
    let mut run = Vec::new();
    for point in points {
        match position(point) {
            Some(found) => run.push(found),
            None => runs.push(std::mem::take(&mut run)),
        }
    }
    runs.push(run);
    runs.retain(|run| run.len() > 1);
    runs
}

/// The plotting area.
pub(super) struct Frame {
    pub(super) x: (f64, f64),
    pub(super) y: (f64, f64),
    pub(super) x_pixels: Range<i32>,
    pub(super) y_pixels: Range<i32>,
}

impl Frame {
    pub(super) fn holds(&self, x: f64, y: f64) -> bool {
        (self.x.0..=self.x.1).contains(&x) && (self.y.0..=self.y.1).contains(&y)
    }

    /// The pixel of a position, held inside the frame.
    pub(super) fn pixel(&self, x: f64, y: f64) -> (i32, i32) {
        let share = |value: f64, (from, to): (f64, f64)| ((value - from) / (to - from)).clamp(0.0, 1.0);
        let along =
            |range: &Range<i32>, share: f64| f64::from(range.start) + share * f64::from(range.end - range.start);
        let pixel_x = along(&self.x_pixels, share(x, self.x));
        let pixel_y = along(&self.y_pixels, 1.0 - share(y, self.y));
        (pixel_x.round() as i32, pixel_y.round() as i32)
    }

    /// The position of a pixel.
    pub(super) fn position(&self, (x, y): (i32, i32)) -> (f64, f64) {
        let share =
            |pixel: i32, range: &Range<i32>| f64::from(pixel - range.start) / f64::from(range.end - range.start);
        let at = |(from, to): (f64, f64), share: f64| from + share * (to - from);
        (at(self.x, share(x, &self.x_pixels)), at(self.y, 1.0 - share(y, &self.y_pixels)))
    }

    /// The parts of a line inside the frame, in pixels.
    pub(super) fn clip(&self, points: &[(f64, f64)]) -> Vec<Vec<(i32, i32)>> {
        let mut pieces: Vec<Vec<(i32, i32)>> = Vec::new();
        let mut joined = false;
        for pair in points.windows(2) {
            let Some((from, to)) = self.inside(pair[0], pair[1]) else {
                joined = false;
                continue;
            };
            let (a, b) = (self.pixel(from.0, from.1), self.pixel(to.0, to.1));
            match pieces.last_mut() {
                Some(piece) if joined => piece.push(b),
                _ => pieces.push(vec![a, b]),
            }
            joined = to == pair[1];
        }
        pieces
    }

    /// The part of a segment inside the frame (Liang and Barsky).
    fn inside(&self, a: (f64, f64), b: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (direction, distance) in
            [(-dx, a.0 - self.x.0), (dx, self.x.1 - a.0), (-dy, a.1 - self.y.0), (dy, self.y.1 - a.1)]
        {
            if direction == 0.0 {
                if distance < 0.0 {
                    return None;
                }
            } else if direction < 0.0 {
                enter = enter.max(distance / direction);
            } else {
                leave = leave.min(distance / direction);
            }
        }
        let at = |share: f64| if share == 1.0 { b } else { (a.0 + share * dx, a.1 + share * dy) };
        (enter <= leave).then(|| (at(enter), at(leave)))
    }
}
