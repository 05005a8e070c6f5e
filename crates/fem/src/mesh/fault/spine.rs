//! The column of the grid that holds the fault: the trace and its continuation to the bottom and the top of the box.
//!
//! x = X(y). Beyond a tip the slope p = dX/dy of the last segment decays as p / (1 + d/L)², where d is the vertical distance
//! from the tip. Cells next to the tip see a straight line, and the line becomes vertical after a shift of p L.

/// A line x = X(y) with the trace in its middle.
#[derive(Debug)]
pub(super) struct Spine {
    /// Vertices, the highest first \[m\].
    pub vertices: Vec<[f64; 2]>,
    /// dX/dy of the segments \[-\].
    pub slopes: Vec<f64>,
    /// L above and below the trace \[m\].
    decay: [f64; 2],
    /// ∫ X dy from the lowest vertex to each vertex \[m²\].
    integrals: Vec<f64>,
}

/// Largest shift of the spine by the decay, as a fraction of the distance between a tip and the side of the box.
const ROOM: f64 = 0.5;

impl Spine {
    /// `vertices`: descending in y; `sides`: x of the left and the right side of the box.
    pub(super) fn new(vertices: Vec<[f64; 2]>, sides: [f64; 2]) -> Self {
        let last = vertices.len() - 1;
        let slopes: Vec<f64> =
            vertices.windows(2).map(|w| (w[1][0] - w[0][0]) / (w[1][1] - w[0][1])).collect();
        let extent = vertices[0][1] - vertices[last][1];
        let decay = |tip: [f64; 2], drift: f64| {
            let room = if drift > 0.0 { sides[1] - tip[0] } else { tip[0] - sides[0] };
            if drift == 0.0 { extent } else { extent.min(ROOM * room / drift.abs()) }
        };
        let decay = [decay(vertices[0], slopes[0]), decay(vertices[last], -slopes[last - 1])];
        let mut integrals = vec![0.0; vertices.len()];
        for k in (0..last).rev() {
            let [a, b] = [vertices[k], vertices[k + 1]];
            integrals[k] = integrals[k + 1] + 0.5 * (a[0] + b[0]) * (a[1] - b[1]);
        }
        Self { vertices, slopes, decay, integrals }
    }

    /// Segment at a height on the trace.
    fn segment(&self, y: f64) -> usize {
        self.vertices[1..].partition_point(|v| y < v[1]).min(self.slopes.len() - 1)
    }

    /// Tip (vertex), slope outwards dX/dd, decay length and distance of a height beyond the trace.
    fn beyond(&self, y: f64) -> Option<(usize, f64, f64, f64)> {
        let last = self.vertices.len() - 1;
        if y > self.vertices[0][1] {
            Some((0, self.slopes[0], self.decay[0], y - self.vertices[0][1]))
        } else if y < self.vertices[last][1] {
            Some((last, -self.slopes[last - 1], self.decay[1], self.vertices[last][1] - y))
        } else {
            None
        }
    }

    /// X(y) \[m\].
    pub(super) fn x(&self, y: f64) -> f64 {
        if let Some((tip, p, l, d)) = self.beyond(y) {
            return self.vertices[tip][0] + p * d / (1.0 + d / l);
        }
        let k = self.segment(y);
        let [a, b] = [self.vertices[k], self.vertices[k + 1]];
        let t = (a[1] - y) / (a[1] - b[1]);
        (1.0 - t) * a[0] + t * b[0]
    }

    /// Slope dX/dy at a height beyond the trace; `None` on it.
    pub(super) fn decayed(&self, y: f64) -> Option<f64> {
        let (tip, p, l, d) = self.beyond(y)?;
        let outward = if tip == 0 { p } else { -p };
        Some(outward / (1.0 + d / l).powi(2))
    }

    /// ∫ X dy from the lowest vertex \[m²\].
    fn integral(&self, y: f64) -> f64 {
        if let Some((tip, p, l, d)) = self.beyond(y) {
            let part = self.vertices[tip][0] * d + p * l * (d - l * (d / l).ln_1p());
            return if tip == 0 { self.integrals[0] + part } else { -part };
        }
        let k = self.segment(y);
        let b = self.vertices[k + 1];
        self.integrals[k + 1] + 0.5 * (b[0] + self.x(y)) * (y - b[1])
    }

    /// Mean of X over [y - r, y + r]: the spine with rounded bends.
    pub(super) fn rounded(&self, y: f64, r: f64) -> f64 {
        if r > 0.0 { (self.integral(y + r) - self.integral(y - r)) / (2.0 * r) } else { self.x(y) }
    }

    /// Smallest and largest X at any height, including the infinite continuations.
    pub(super) fn range(&self) -> [f64; 2] {
        let last = self.vertices.len() - 1;
        let ends = [
            self.vertices[0][0] + self.slopes[0] * self.decay[0],
            self.vertices[last][0] - self.slopes[last - 1] * self.decay[1],
        ];
        let all = self.vertices.iter().map(|v| v[0]).chain(ends);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], x| [lo.min(x), hi.max(x)])
    }

    /// Total variation of dX/dy over all heights \[-\].
    pub(super) fn variation(&self) -> f64 {
        let bends: f64 = self.slopes.windows(2).map(|w| (w[1] - w[0]).abs()).sum();
        bends + self.slopes[0].abs() + self.slopes[self.slopes.len() - 1].abs()
    }

    /// Direction in which a row leaves the spine to the right, per horizontal distance of the columns: sin δ (sin δ, cos δ) for
    /// the dip δ. It is perpendicular to the spine, and the thickness of cells equals the distance of columns. Around a bend it
    /// changes from one segment's to the next's; the row through the vertex halves the angle.
    pub(super) fn across(&self, y: f64) -> [f64; 2] {
        let of = |p: f64| [1.0 / (1.0 + p * p), -p / (1.0 + p * p)];
        if let Some(p) = self.decayed(y) {
            return of(p);
        }
        let height = |k: usize| self.vertices[k][1] - self.vertices[k + 1][1];
        for k in 1..self.slopes.len() {
            let half = TRANSITION * height(k - 1).min(height(k));
            let d = self.vertices[k][1] - y;
            if d.abs() < half {
                let (t, segment) = (d.abs() / half, if d < 0.0 { k - 1 } else { k });
                let (at, away) = (self.bisector(k), of(self.slopes[segment]));
                return std::array::from_fn(|c| (1.0 - t) * at[c] + t * away[c]);
            }
        }
        of(self.slopes[self.segment(y)])
    }

    /// Dip of a segment, from the x axis downwards \[rad\].
    pub(super) fn dip(&self, segment: usize) -> f64 {
        1.0_f64.atan2(-self.slopes[segment])
    }

    /// [`Spine::across`] at an inner vertex.
    fn bisector(&self, vertex: usize) -> [f64; 2] {
        let (a, b) = (self.dip(vertex - 1), self.dip(vertex));
        let (scale, middle) = (0.5 * (a.sin() + b.sin()), 0.5 * (a + b));
        [scale * middle.sin(), scale * middle.cos()]
    }
}

/// Fraction of the shorter segment at a bend over which rows turn from one normal to the other.
const TRANSITION: f64 = 0.4;
