//! Where the words of a chart go, so that none lies on another.

/// A rectangle on the page, in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rect {
    pub(super) fn about((x, y): (f64, f64), width: f64, height: f64) -> Self {
        Self { left: x - width / 2.0, top: y - height / 2.0, width, height }
    }

    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.left < other.right() && other.left < self.right() && self.top < other.bottom() && other.top < self.bottom()
    }

    fn holds(&self, other: &Self) -> bool {
        self.left <= other.left
            && self.top <= other.top
            && self.right() >= other.right()
            && self.bottom() >= other.bottom()
    }

    /// Its point nearest to another.
    pub(super) fn nearest(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x.clamp(self.left, self.right()), y.clamp(self.top, self.bottom()))
    }
}

/// Width of a text in a sans-serif face, in pixels: a little more than most faces need.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let units = text.chars().map(|c| match c {
        'i' | 'j' | 'l' | 't' | 'f' | 'r' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | ' ' | '(' | ')' => 0.36,
        'm' | 'w' | 'M' | 'W' | '%' => 0.92,
        c if c.is_uppercase() => 0.70,
        _ => 0.60,
    });
    size * units.sum::<f64>()
}

/// Distances from a point to its label that are tried, in pixels; a leader is drawn from the second on.
const DISTANCES: [f64; 6] = [8.0, 18.0, 30.0, 44.0, 60.0, 80.0];
/// Directions in order of liking: right, above right, left ...
const DIRECTIONS: [(f64, f64); 12] = [
    (1.0, 0.0),
    (0.8, -0.6),
    (0.8, 0.6),
    (-1.0, 0.0),
    (-0.8, -0.6),
    (-0.8, 0.6),
    (0.0, -1.0),
    (0.0, 1.0),
    (0.4, -0.9),
    (0.4, 0.9),
    (-0.4, -0.9),
    (-0.4, 0.9),
];

/// A place for a label `size` beside a point, and whether it lies so far off that a line should lead to it: within `bounds`,
/// off everything in `taken`. `None` where all is full.
pub(super) fn place(at: (f64, f64), size: (f64, f64), bounds: &Rect, taken: &[Rect]) -> Option<(Rect, bool)> {
    DISTANCES.iter().enumerate().find_map(|(ring, distance)| {
        DIRECTIONS.iter().find_map(|(dx, dy)| {
            // The box lies beyond the distance in its direction.
            let x = at.0 + dx * distance + dx.signum() * if dx.abs() > 0.3 { size.0 / 2.0 } else { 0.0 };
            let y = at.1 + dy * (distance + size.1 / 2.0);
            let rect = Rect::about((x, y), size.0, size.1);
            (bounds.holds(&rect) && !taken.iter().any(|other| rect.meets(other))).then_some((rect, ring > 0))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use onelight::lut::SceneSampler;

    #[test]
    fn labels_never_lie_on_each_other_and_stay_inside() {
        let bounds = Rect { left: 0.0, top: 0.0, width: 500.0, height: 400.0 };
        // Points crowd in a quarter of the chart.
        let points: Vec<(f64, f64)> = SceneSampler::new(0.0..=0.0)
            .unwrap()
            .take(60)
            .map(|[r, g, _]| (30.0 + 1200.0 * r, 20.0 + 900.0 * g))
            .collect();
        let mut taken: Vec<Rect> = points.iter().map(|&at| Rect::about(at, 8.0, 8.0)).collect();
        let mut placed = 0;
        for &at in &points {
            let Some((rect, _)) = place(at, (width("structured 32", 11.0), 13.0), &bounds, &taken) else { continue };
            assert!(bounds.holds(&rect) && !taken.iter().any(|other| other.meets(&rect)));
            taken.push(rect);
            placed += 1;
        }
        assert!(placed > 20, "{placed}");
    }

    #[test]
    fn a_lonely_point_has_its_label_beside_it() {
        let bounds = Rect { left: 0.0, top: 0.0, width: 100.0, height: 100.0 };
        let (rect, leader) = place((20.0, 50.0), (40.0, 10.0), &bounds, &[]).unwrap();
        assert_eq!((rect.left, rect.top, leader), (28.0, 45.0, false));
        let (rect, _) = place((90.0, 50.0), (40.0, 10.0), &bounds, &[]).unwrap();
        assert_eq!(rect.right(), 82.0, "no room on the right");
    }
}
