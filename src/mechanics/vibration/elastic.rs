//! Stiffness matrix of a configuration in factored form: derivatives of strains with respect to displacements, and section stiffnesses.
//!
//! Section forces are unknowns in addition to the displacements. Section stiffnesses multiply only the residuals and corrections of the strains.
//! Therefore the rounding errors of force residuals are proportional to section forces, not to stiffnesses.

use pulp::{Arch, Simd, WithSimd};

use crate::beams::SpanStiffness;
use crate::elementary::square;
use crate::linalg::{STRIP_WIDTH, VectorStrip};

pub(super) type FourVectors = [f64; STRIP_WIDTH];

#[derive(Debug, Clone, Default)]
pub(super) struct Elastic {
    spans: Vec<StrainRows>,
    unknowns: Vec<u32>,
    /// Data of one span after the other: the rows of its strains, then the pairs of rows `p` and `q` of its geometric stiffness `p qᵀ + q pᵀ`.
    rows: Vec<f64>,
    stiffness: Vec<f64>,
    rounding_fractions: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
struct StrainRows {
    width: usize,
    strains: usize,
    twists: usize,
}

#[derive(Debug, Clone)]
pub(super) struct Shapes {
    pub(super) movements: Vec<FourVectors>,
    forces: Vec<FourVectors>,
    mismatches: Vec<FourVectors>,
    pub(super) internal_forces: Vec<FourVectors>,
}

impl Shapes {
    /// Section forces of the first of the four shapes, times their integration lengths.
    pub(super) fn first_forces(&self) -> Vec<f64> {
        self.forces.iter().map(|row| row[0]).collect()
    }

    pub(super) fn scale(&mut self, factors: &FourVectors) {
        let Self { movements, forces, mismatches: missing, internal_forces: resisting } = self;
        for row in movements.iter_mut().chain(forces).chain(missing).chain(resisting) {
            row.iter_mut().zip(factors).for_each(|(entry, factor)| *entry *= factor);
        }
    }
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Energies {
    pub(super) double_energy: FourVectors,
    pub(super) correction: FourVectors,
}

impl Elastic {
    pub(super) fn add(&mut self, size: usize, degrees: &[usize], span: &SpanStiffness) {
        let (strains, twists) = (span.stiffness.len(), span.rounding_fractions.len());
        self.spans.push(StrainRows { width: degrees.len(), strains, twists });
        self.unknowns.extend(degrees.iter().map(|&at| at.min(size) as u32));
        self.rows.extend(&span.strains);
        self.rows.extend(&span.twists);
        self.stiffness.extend(&span.stiffness);
        self.rounding_fractions.extend(&span.rounding_fractions);
    }

    pub(super) fn strains(&self) -> usize {
        self.stiffness.len()
    }

    /// Memory for `strains` rows with `width` entries each [bytes].
    pub(super) fn memory(strains: usize, width: usize) -> usize {
        strains * (width + 1) * size_of::<f64>()
    }

    pub(super) fn room(&self, length: usize) -> Shapes {
        let rows = vec![[0.0; STRIP_WIDTH]; self.strains()];
        let vector = vec![[0.0; STRIP_WIDTH]; length];
        Shapes {
            forces: rows.clone(),
            mismatches: rows,
            internal_forces: vector.clone(),
            movements: vector,
        }
    }

    pub(super) fn begin(&self, movements: &VectorStrip, shapes: &mut Shapes) -> Energies {
        shapes.movements.fill([0.0; STRIP_WIDTH]);
        shapes.forces.fill([0.0; STRIP_WIDTH]);
        shapes.mismatches.fill([0.0; STRIP_WIDTH]);
        self.correct(shapes, movements)
    }

    pub(super) fn correct(&self, shapes: &mut Shapes, by: &VectorStrip) -> Energies {
        Arch::new().dispatch(ShapeCorrection { elastic: self, shapes, by })
    }

    pub(super) fn rounding_of(&self, movements: &VectorStrip) -> FourVectors {
        Arch::new().dispatch(Rounding { elastic: self, movements })
    }

    #[inline(always)]
    fn each_span(&self, mut take: impl FnMut(ElasticSpan<'_>)) {
        let (mut unknown, mut entry, mut strain, mut twist) = (0, 0, 0, 0);
        for &StrainRows { width, strains, twists } in &self.spans {
            let count = (strains + 2 * twists) * width;
            let (rows, pairs) = self.rows[entry..][..count].split_at(strains * width);
            take(ElasticSpan {
                unknowns: &self.unknowns[unknown..][..width],
                rows,
                pairs,
                strain,
                twist,
            });
            unknown += width;
            entry += count;
            strain += strains;
            twist += twists;
        }
    }
}

struct ElasticSpan<'a> {
    unknowns: &'a [u32],
    rows: &'a [f64],
    pairs: &'a [f64],
    strain: usize,
    twist: usize,
}

/// Largest number of unknowns of a span: three per basis function, for degree 10.
const WIDEST: usize = 33;

#[inline(always)]
fn gather<const WIDTH: usize>(unknowns: &[u32], of: &VectorStrip) -> [FourVectors; WIDTH] {
    let mut gathered = [[0.0; STRIP_WIDTH]; WIDTH];
    for (to, at) in gathered.iter_mut().zip(unknowns) {
        *to = of[*at as usize];
    }
    gathered
}

#[inline(always)]
fn along<const WIDTH: usize>(row: &[f64], of: &[FourVectors; WIDTH]) -> FourVectors {
    let mut sum = [0.0; STRIP_WIDTH];
    for (entry, of) in row.iter().zip(of) {
        for (sum, of) in sum.iter_mut().zip(of) {
            *sum += entry * of;
        }
    }
    sum
}

#[inline(always)]
fn spread<const WIDTH: usize>(row: &[f64], value: &FourVectors, to: &mut [FourVectors; WIDTH]) {
    for (entry, to) in row.iter().zip(to) {
        for (to, value) in to.iter_mut().zip(value) {
            *to += entry * value;
        }
    }
}

struct ShapeCorrection<'a> {
    elastic: &'a Elastic,
    shapes: &'a mut Shapes,
    by: &'a VectorStrip,
}

impl WithSimd for ShapeCorrection<'_> {
    type Output = Energies;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Energies {
        let Self { elastic, shapes, by } = self;
        for (x, by) in shapes.movements.iter_mut().zip(by) {
            x.iter_mut().zip(by).for_each(|(x, by)| *x += by);
        }
        shapes.internal_forces.fill([0.0; STRIP_WIDTH]);
        let mut energies = Energies::default();
        elastic.each_span(|span| match span.unknowns.len() {
            6 => correct_span::<6>(elastic, &span, shapes, by, &mut energies),
            9 => correct_span::<9>(elastic, &span, shapes, by, &mut energies),
            12 => correct_span::<12>(elastic, &span, shapes, by, &mut energies),
            _ => correct_span::<WIDEST>(elastic, &span, shapes, by, &mut energies),
        });
        energies
    }
}

#[inline(always)]
fn correct_span<const WIDTH: usize>(
    elastic: &Elastic,
    &ElasticSpan { unknowns, rows, pairs, strain, .. }: &ElasticSpan<'_>,
    Shapes { movements, forces, mismatches: missing, internal_forces: resisting }: &mut Shapes,
    by: &VectorStrip,
    energies: &mut Energies,
) {
    let width = unknowns.len();
    let x: [FourVectors; WIDTH] = gather(unknowns, movements);
    let by: [FourVectors; WIDTH] = gather(unknowns, by);
    let mut out = [[0.0; STRIP_WIDTH]; WIDTH];
    for (at, row) in rows.chunks_exact(width).enumerate() {
        let stiffness = elastic.stiffness[strain + at];
        let flexibility = 1.0 / stiffness;
        let (force, missing) = (&mut forces[strain + at], &mut missing[strain + at]);
        let (change, now) = (along(row, &by), along(row, &x));
        let mut whole = [0.0; STRIP_WIDTH];
        for lane in 0..STRIP_WIDTH {
            let change = stiffness * (missing[lane] + change[lane]);
            force[lane] += change;
            let strain = force[lane] * flexibility;
            missing[lane] = now[lane] - strain;
            whole[lane] = force[lane] + stiffness * missing[lane];
            energies.double_energy[lane] += force[lane] * strain;
            energies.correction[lane] += change * change * flexibility;
        }
        spread(row, &whole, &mut out);
    }
    for pair in pairs.chunks_exact(2 * width) {
        let (p, q) = pair.split_at(width);
        let (along_p, along_q) = (along(p, &x), along(q, &x));
        let (by_p, by_q) = (along(p, &by), along(q, &by));
        for lane in 0..STRIP_WIDTH {
            energies.double_energy[lane] += 2.0 * along_p[lane] * along_q[lane];
            energies.correction[lane] += 2.0 * by_p[lane] * by_q[lane];
        }
        spread(p, &along_q, &mut out);
        spread(q, &along_p, &mut out);
    }
    for (at, out) in unknowns.iter().zip(&out) {
        resisting[*at as usize].iter_mut().zip(out).for_each(|(to, out)| *to += out);
    }
}

struct Rounding<'a> {
    elastic: &'a Elastic,
    movements: &'a VectorStrip,
}

impl WithSimd for Rounding<'_> {
    type Output = FourVectors;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> FourVectors {
        let Self { elastic, movements } = self;
        let mut sums = [0.0; STRIP_WIDTH];
        let sizes = |row: &[f64], x: &[FourVectors; WIDEST]| -> FourVectors {
            let mut sizes = [0.0; STRIP_WIDTH];
            for (entry, x) in row.iter().zip(x) {
                for (size, x) in sizes.iter_mut().zip(x) {
                    *size += (entry * x).abs();
                }
            }
            sizes
        };
        elastic.each_span(|ElasticSpan { unknowns, rows, pairs, strain, twist }| {
            let (width, x) = (unknowns.len(), gather(unknowns, movements));
            for (at, row) in rows.chunks_exact(width).enumerate() {
                for (sum, size) in sums.iter_mut().zip(sizes(row, &x)) {
                    *sum += elastic.stiffness[strain + at] * square(f64::EPSILON * size);
                }
            }
            for (at, pair) in pairs.chunks_exact(2 * width).enumerate() {
                let (p, q) = pair.split_at(width);
                let part = f64::EPSILON + elastic.rounding_fractions[twist + at];
                for ((sum, p), q) in sums.iter_mut().zip(sizes(p, &x)).zip(sizes(q, &x)) {
                    *sum += 2.0 * part * p * q;
                }
            }
        });
        sums
    }
}
