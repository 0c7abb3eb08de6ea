//! Impacts of sliders at corners of a track, where they pass from beam to beam (docs/theory.md, section 10.3).
//!
//! A corner of a track is the limit of a rounded corner: the contact impulses are normal to the rotating tangent and do no work.
//! The relative velocity of the slave rotates with the tangent. Angles are measured in a metric that depends on the masses.
//! The rotation of the tangent is the change of the section angle plus the change of the shear angle from the first beam to the second.
//! The impulses of the change of the section angle excite no vibrations that the steps do not resolve.
//! The impulses of the change of the shear angle may excite all vibrations. They are applied last.

use super::System;
use super::impact::{ImpactDirection, ImpactImpulses, ImpactLaw, ImpactProblem};
use super::rigidity::Deformation;
use crate::elementary::{atan2, sin_cos, square};
use crate::geometry::{Vec2, cross, perpendicular};
use crate::linalg::{BandedMatrix, LinearError, Pairing, complementary};
use crate::system::sliders::{MasterEnd, MasterLimit, Seam};

/// Largest angle between two tangents that count as parallel [rad].
const STRAIGHT: f64 = 1e-13;

/// Limit of the determinant of the velocity response, as a fraction of its squared trace.
/// Below this limit, impulses can change the velocity in one direction only, and the velocity is not rotated.
const ONE_WAY: f64 = 1e-20;

/// Largest number of iterations for the rotation angles of coupled sliders that pass corners simultaneously.
const CORRECTIONS: usize = 40;

/// Tolerance of the iteration for the rotation angle at a corner [rad].
const RIGHT: f64 = 1e-12;

/// Range of accepted estimates of a derivative: of the rotation angle of the velocity with respect to the field `angle` of `TurnSearch`.
const SLOPES: std::ops::Range<f64> = 0.2..5.0;

/// Corner of a track that a slider passes, with the directions before and after the corner [-].
#[derive(Debug, Clone, Copy)]
pub(super) struct SeamCorner {
    pub(super) slider: usize,
    incoming: Vec2,
    outgoing: Vec2,
}

impl SeamCorner {
    pub(super) fn directions(corners: &[Self]) -> Vec<ImpactDirection> {
        let both =
            |Self { slider, .. }: &Self| [Vec2::x(), Vec2::y()].map(|unit| (*slider, unit.into()));
        corners.iter().flat_map(both).collect()
    }

    pub(super) fn new(slider: usize, incoming: Vec2, outgoing: Vec2) -> Self {
        Self { slider, incoming, outgoing }
    }

    fn is_straight(&self) -> bool {
        cross(self.incoming, self.outgoing).abs() <= STRAIGHT
            && self.incoming.dot(&self.outgoing) > 0.0
    }
}

pub(super) struct SeamCrossings {
    passing: Vec<(usize, MasterEnd, Seam)>,
    sections: Vec<SeamCorner>,
    shear: Vec<SeamCorner>,
}

impl SeamCrossings {
    pub(super) fn corners_of_sections(&self) -> &[SeamCorner] {
        if self.sections.iter().all(SeamCorner::is_straight) { &[] } else { &self.sections }
    }
}

/// Symmetric matrix whose product with an impulse on a slider is the change of the relative velocity of the slider, given by rows [1/mass].
#[derive(Debug, Clone, Copy)]
struct Response([Vec2; 2]);

impl Response {
    fn times(&self, impulse: Vec2) -> Vec2 {
        Vec2::new(self.0[0].dot(&impulse), self.0[1].dot(&impulse))
    }

    fn determinant(&self) -> f64 {
        cross(self.0[0], self.0[1])
    }

    fn trace(&self) -> f64 {
        self.0[0].x + self.0[1].y
    }

    fn is_one_way(&self) -> bool {
        self.determinant() <= ONE_WAY * square(self.trace())
    }

    /// Rotation angle between two velocities in the metric of the inverse velocity response [rad].
    fn angle(&self, from: Vec2, to: Vec2) -> f64 {
        let along = perpendicular(from).dot(&self.times(perpendicular(to)));
        atan2(self.determinant().sqrt() * cross(from, to), along)
    }
}

impl System {
    pub(crate) fn continues_beyond(&self, limit: MasterLimit) -> bool {
        self.sliders[limit.slider].seam(&self.bodies, limit.end).is_some()
    }

    pub(crate) fn is_at_seam_event(&self, slider: usize) -> bool {
        self.sliders[slider].crossed_seam_at(self.motion.time)
    }

    pub(super) fn passages(&self, limits: &[MasterLimit]) -> SeamCrossings {
        let passing = limits.iter().filter_map(|&MasterLimit { slider, end }| {
            Some((slider, end, self.sliders[slider].seam(&self.bodies, end)?))
        });
        let passing: Vec<(usize, MasterEnd, Seam)> = passing.collect();
        let corners = passing.iter().filter_map(|(slider, end, seam)| {
            let [comes, goes] = self.sliders[*slider].corner(&self.bodies, *end, *seam)?;
            let with_sections = turned(comes, self.sections_at(*slider, *end, *seam)?);
            let corner =
                |comes, goes| SeamCorner { slider: *slider, incoming: comes, outgoing: goes };
            Some((corner(comes, with_sections), corner(with_sections, goes)))
        });
        let (of_sections, of_shear) = corners.unzip();
        SeamCrossings { passing, sections: of_sections, shear: of_shear }
    }

    pub(super) fn pass_seams(&mut self, passages: &SeamCrossings) -> Result<(), LinearError> {
        self.deflect(&passages.shear, Deformation::All)?;
        let time = self.motion.time;
        for (slider, _, seam) in &passages.passing {
            self.sliders[*slider].cross_seam(*seam);
            self.sliders[*slider].record_crossing(time);
            self.motion.accelerations.mark_unknown();
        }
        Ok(())
    }

    /// Rotates the relative velocities of sliders at ends of masters from the kinked axis onto the smooth axis, and removes the kinks.
    /// A kink is a jump of the tangent of the axis under a contact force.
    pub(super) fn straighten_kinks(&mut self, limits: &[MasterLimit]) -> Result<(), LinearError> {
        let rates = &self.motion.rates;
        let corner = |&MasterLimit { slider, end }: &MasterLimit| {
            let [comes, goes] = self.sliders[slider].off_kink(&self.bodies, rates, end)?;
            Some(SeamCorner::new(slider, comes, goes))
        };
        let corners: Vec<SeamCorner> = limits.iter().filter_map(corner).collect();
        self.deflect(&corners, Deformation::All)?;
        corners.iter().for_each(|corner| self.sliders[corner.slider].straighten());
        Ok(())
    }

    fn sections_at(&self, slider: usize, end: MasterEnd, seam: Seam) -> Option<[Vec2; 2]> {
        let slider = &self.sliders[slider];
        let along = |beam: usize, end: MasterEnd| {
            let (sine, cosine) = sin_cos(self.section_angle(2 * beam + end as usize)?);
            Some(Vec2::new(cosine, sine) * end.outward())
        };
        let beyond = along(slider.beam_beyond(seam)?, seam.end)?;
        Some([along(slider.connection.master, end)?, -beyond])
    }

    pub(super) fn deflect(
        &mut self,
        corners: &[SeamCorner],
        deformation: Deformation,
    ) -> Result<(), LinearError> {
        if corners.iter().all(SeamCorner::is_straight) {
            return Ok(());
        }
        let passes = |slider: usize| corners.iter().any(|corner| corner.slider == slider);
        let others = self.sliders.directions(&self.bodies);
        let others: Vec<ImpactDirection> = others.filter(|(slider, _)| !passes(*slider)).collect();
        let turned = SeamCorner::directions(corners);
        let met = [(&turned[..], deformation), (&others, deformation)];
        let problem = self.impact_problem(&met, -2.0)?;
        if let Some(impulses) =
            deflect_at_corners(&problem, corners, &vec![ImpactLaw::Elastic; others.len()])?
        {
            self.apply(problem, &impulses.values);
        }
        Ok(())
    }
}

fn turned(direction: Vec2, [from, to]: [Vec2; 2]) -> Vec2 {
    direction * from.dot(&to) + perpendicular(direction) * cross(from, to)
}

/// Computes the impulses of an impact in which corners rotate the velocities of sliders (docs/theory.md, section 10.3).
/// All contacts without a corner follow their impact laws.
/// The rotation angle of each corner is reached to 1e-12 rad, or as accurately as possible.
/// The result is `None` if the rotation angles are not reached while contacts that can only push are also struck.
pub(super) fn deflect_at_corners(
    problem: &ImpactProblem,
    corners: &[SeamCorner],
    laws: &[ImpactLaw],
) -> Result<Option<ImpactImpulses>, LinearError> {
    if corners.is_empty() {
        return Ok(Some(problem.impulses(laws)?));
    }
    let own = own_responses(problem, corners, laws)?;
    let half_way = problem.mean_velocity();
    let lacks = [vec![0.0; 2 * corners.len()], problem.lacks(laws)?].concat();
    let tied = corners.iter().flat_map(|_| [Pairing::Equality; 2]);
    let pairings: Vec<Pairing> = tied.chain(laws.iter().map(|law| law.pairing())).collect();
    let mut bends: Vec<TurnSearch> = corners.iter().zip(&own).map(TurnSearch::new).collect();
    let strikes = pairings.contains(&Pairing::Complementary);
    let mut last = None;
    for _ in 0..CORRECTIONS {
        let (mut matrix, mut missing) = (problem.response.clone(), lacks.clone());
        for (at, bend) in bends.iter().enumerate() {
            let [x, y] = [2 * at, 2 * at + 1];
            let (keeps, swings) = bend.row();
            for (row, from, sign) in [(x, y, swings), (y, x, -swings)] {
                matrix[row] = problem.response[from].iter().map(|w| w * sign).collect();
                matrix[row][row] += keeps;
                missing[row] = 2.0 * half_way[from] * sign;
            }
        }
        let impulses = complementary(&matrix, &missing, &pairings)?;
        let mut is_right = true;
        for (at, bend) in bends.iter_mut().enumerate() {
            let [x, y] =
                [2 * at, 2 * at + 1].map(|row| problem.approach_velocities(row, &impulses));
            let (before, change) = (Vec2::new(x.0, y.0), Vec2::new(x.1, y.1));
            is_right &= bend.correct(before, before + change);
        }
        if is_right {
            return Ok(Some(problem.with_mean_velocities(impulses)));
        }
        last = Some(impulses);
    }
    Ok(last.filter(|_| !strikes).map(|impulses| problem.with_mean_velocities(impulses)))
}

/// Velocity response of each slider at a corner to its own impulse.
/// The velocity response includes the reactions of the contacts that keep slaves on their masters.
fn own_responses(
    problem: &ImpactProblem,
    corners: &[SeamCorner],
    laws: &[ImpactLaw],
) -> Result<Vec<Response>, LinearError> {
    let (response, first) = (&problem.response, 2 * corners.len());
    let is_tied = |at: &usize| laws[at - first].pairing() == Pairing::Equality;
    let tied: Vec<usize> = (first..response.len()).filter(is_tied).collect();
    let entries = |row: usize| -> Vec<f64> { tied.iter().map(|at| response[row][*at]).collect() };
    let among: Vec<Vec<f64>> = tied.iter().map(|row| entries(*row)).collect();
    let own = |at: usize| -> Result<Response, LinearError> {
        let mut rows = [Vec2::zeros(); 2];
        for column in [0, 1] {
            let of_tied = entries(2 * at + column);
            let answers = if tied.is_empty() { of_tied } else { solve(&among, of_tied)? };
            for row in [0, 1] {
                let (to_tied, whole) =
                    (entries(2 * at + row), response[2 * at + row][2 * at + column]);
                rows[row][column] =
                    whole - to_tied.iter().zip(&answers).map(|(a, p)| a * p).sum::<f64>();
            }
        }
        Ok(Response(rows))
    };
    (0..corners.len()).map(own).collect()
}

struct TurnSearch {
    own: Response,
    required_angle: f64,
    angle: f64,
    before: Option<(f64, f64)>,
}

impl TurnSearch {
    fn new((corner, own): (&SeamCorner, &Response)) -> Self {
        let required_angle = own.angle(corner.incoming, corner.outgoing);
        Self { own: *own, required_angle, angle: required_angle, before: None }
    }

    fn row(&self) -> (f64, f64) {
        let (sine, cosine) = sin_cos(0.5 * self.angle);
        match self.own.is_one_way() {
            true => (self.own.trace(), 0.0),
            false => (cosine * self.own.determinant().sqrt(), sine),
        }
    }

    fn correct(&mut self, before: Vec2, after: Vec2) -> bool {
        if self.own.is_one_way() || before == Vec2::zeros() {
            return true;
        }
        let off = self.own.angle(before, after) - self.required_angle;
        let slope = self.before.map(|(angle, other)| (off - other) / (self.angle - angle));
        let slope = slope.filter(|slope| SLOPES.contains(slope)).unwrap_or(1.0);
        self.before = Some((self.angle, off));
        self.angle -= off / slope;
        off.abs() <= RIGHT
    }
}

fn solve(matrix: &[Vec<f64>], mut rhs: Vec<f64>) -> Result<Vec<f64>, LinearError> {
    let count = rhs.len();
    let mut dense = BandedMatrix::zeros(count, count - 1);
    for (row, entries) in matrix.iter().enumerate() {
        entries.iter().enumerate().for_each(|(column, entry)| dense.add(row, column, *entry));
    }
    dense.factorise()?.solve(&mut rhs);
    Ok(rhs)
}
