//! Sliders that pass from beam to beam of a track: what a corner between the two does to velocities.
//!
//! A corner is the limit of a rounded one. While the tangent turns, the contact keeps `w`, the velocity of the slave relative to its place, along it by
//! impulses across, which do no work: `½ w·W⁻¹w` stays, with `W = G M⁻¹ Gᵀ` as in an impact. So `w` turns with the tangent, in the metric `W⁻¹`:
//!
//! ```text
//! w⁺ = w⁻ + W P        P = γ J ½ (w⁻ + w⁺)        γ = 2 tan(θ/2)/√det W
//! ```
//!
//! with the angle `θ` between the two tangents in that metric. Sections turn it first, for which `G` is what steps follow of the velocity, as in a blow;
//! then what is left, the difference of the shear of both sides, for which it is the velocity itself. Derived in docs/theory.md, section 10.3.

use super::Model;
use super::blows::RIGID;
use super::impact::{Direction, Encounter};
use crate::elementary::{atan2, sin_cos};
use crate::geometry::{Vec2, cross, perpendicular};
use crate::linalg::{BandedMatrix, LinearError};
use crate::model::ModelError;
use crate::model::sliders::{MasterEnd, MasterLimit, Seam};

/// Tangents whose directions differ by less than this angle are one: rounding [rad].
const STRAIGHT: f64 = 1e-13;

/// What moves in one direction only, by this part of what it moves at all, is turned by no corner.
const ONE_WAY: f64 = 1e-20;

/// The most times that the angles of corners are corrected that are passed together, where those who pass move each other.
const CORRECTIONS: usize = 30;

/// An angle that is off by less is right [rad].
const RIGHT: f64 = 1e-12;

/// A corner that a slider passes: the directions in which it comes and goes [-].
#[derive(Debug, Clone, Copy)]
struct Corner {
    slider: usize,
    comes: Vec2,
    goes: Vec2,
}

impl Corner {
    fn is_straight(&self) -> bool {
        cross(self.comes, self.goes).abs() <= STRAIGHT && self.comes.dot(&self.goes) > 0.0
    }
}

/// How the relative velocity of a slider answers to an impulse on it: the symmetric matrix `W` by its rows [1/mass].
#[derive(Debug, Clone, Copy)]
struct Response([Vec2; 2]);

impl Response {
    fn times(&self, impulse: Vec2) -> Vec2 {
        Vec2::new(self.0[0].dot(&impulse), self.0[1].dot(&impulse))
    }

    fn determinant(&self) -> f64 {
        cross(self.0[0], self.0[1])
    }

    fn is_one_way(&self) -> bool {
        let trace = self.0[0].x + self.0[1].y;
        self.determinant() <= ONE_WAY * trace * trace
    }

    /// The angle by which one velocity has to be turned to have the direction of another one, in the metric `W⁻¹` [rad].
    fn angle(&self, from: Vec2, to: Vec2) -> f64 {
        // `det W` times the scalar product.
        let along = perpendicular(from).dot(&self.times(perpendicular(to)));
        atan2(self.determinant().sqrt() * cross(from, to), along)
    }
}

impl Model {
    /// Whether the track of a slider goes on beyond a limit, so that it does not end there.
    pub fn goes_on(&self, limit: MasterLimit) -> bool {
        self.sliders[limit.slider].seam(&self.bodies, limit.end).is_some()
    }

    /// Whether a slider came to a seam at the present moment, or left one on which it leant.
    pub fn came_to_seam_now(&self, slider: usize) -> bool {
        self.sliders[slider].came_to_seam_at(self.motion.time)
    }

    /// Sliders that are at seams of their tracks pass to the other sides, all at the present moment together, in steps of such a length [time].
    ///
    /// # Errors
    /// When the impulses are not determined.
    pub fn pass_seams(&mut self, limits: &[MasterLimit], dt: f64) -> Result<(), ModelError> {
        let passing = limits.iter().filter_map(|&MasterLimit { slider, end }| {
            Some((slider, end, self.sliders[slider].seam(&self.bodies, end)?))
        });
        let passing: Vec<(usize, MasterEnd, Seam)> = passing.collect();
        let corners = passing.iter().filter_map(|(slider, end, seam)| {
            let [comes, goes] = self.sliders[*slider].corner(&self.bodies, *end, *seam)?;
            let with_sections = turned(comes, self.sections_at(*slider, *end, *seam)?);
            let corner = |comes, goes| Corner { slider: *slider, comes, goes };
            Some((corner(comes, with_sections), corner(with_sections, goes)))
        });
        let (of_sections, of_shear): (Vec<Corner>, Vec<Corner>) = corners.unzip();
        self.turn(&of_sections, Some(RIGID * dt))
            .and_then(|()| self.turn(&of_shear, None))
            .map_err(|_| self.sliders.overdetermined())?;
        let time = self.motion.time;
        for (slider, _, seam) in passing {
            self.sliders[slider].pass(seam);
            self.sliders[slider].note_passing(time);
        }
        self.motion.accelerations.forget();
        Ok(())
    }

    /// Sliders that are at ends of kinked axes, where no kink has an energy, turn onto the axes as they are: what their kinks vibrate with goes into the
    /// motion along.
    pub(super) fn straighten_kinks(&mut self, limits: &[MasterLimit]) -> Result<(), LinearError> {
        let rates = &self.motion.rates;
        let corner = |&MasterLimit { slider, end }: &MasterLimit| {
            let [comes, goes] = self.sliders[slider].off_kink(&self.bodies, rates, end)?;
            Some(Corner { slider, comes, goes })
        };
        let corners: Vec<Corner> = limits.iter().filter_map(corner).collect();
        self.turn(&corners, None)?;
        corners.iter().for_each(|corner| self.sliders[corner.slider].straighten());
        Ok(())
    }

    /// The directions of the axis, as sections have them that are not sheared, in which a slider leaves the one side of a seam and comes to the other [-].
    fn sections_at(&self, slider: usize, end: MasterEnd, seam: Seam) -> Option<[Vec2; 2]> {
        let slider = &self.sliders[slider];
        let along = |beam: usize, end: MasterEnd| {
            let (sine, cosine) = sin_cos(self.section_angle(2 * beam + end as usize)?);
            Some(Vec2::new(cosine, sine) * end.outward())
        };
        let beyond = along(slider.beam_beyond(seam)?, seam.end)?;
        Some([along(slider.connection.master, end)?, -beyond])
    }

    /// Turns the relative velocities of sliders round corners, met by what steps of length `rigid_within` follow of the motion, or by all of it.
    fn turn(&mut self, corners: &[Corner], rigid_within: Option<f64>) -> Result<(), LinearError> {
        if corners.iter().all(Corner::is_straight) {
            return Ok(());
        }
        let passes = |slider: usize| corners.iter().any(|corner| corner.slider == slider);
        let turned = corners
            .iter()
            .flat_map(|Corner { slider, .. }| [(*slider, Vec2::x()), (*slider, Vec2::y())]);
        let others = self.sliders.directions(&self.bodies);
        let others = others.into_iter().filter(|(slider, _)| !passes(*slider));
        let directions: Vec<Direction> = turned.chain(others).collect();
        let encounter = self.encounter(&directions, -2.0, rigid_within)?;
        let impulses = turning(&encounter, corners)?;
        self.apply(encounter, &impulses);
        Ok(())
    }
}

/// A direction turned by the angle between two others.
fn turned(direction: Vec2, [from, to]: [Vec2; 2]) -> Vec2 {
    direction * from.dot(&to) + perpendicular(direction) * cross(from, to)
}

/// The impulses that turn the relative velocities of sliders round corners, two for each, and then those by which all other contacts of an encounter answer.
fn turning(encounter: &Encounter, corners: &[Corner]) -> Result<Vec<f64>, LinearError> {
    let (response, half_way) = (&encounter.response, encounter.half_way());
    let (turned, all) = (2 * corners.len(), half_way.len());
    // What the others make of impulses in the first directions, and of velocities: `w⁺ = -w⁻`.
    let tied = (turned..all).map(|row| response[row][turned..].to_vec()).collect::<Vec<_>>();
    let solve_tied = |rhs: Vec<f64>| if rhs.is_empty() { Ok(rhs) } else { solve(&tied, rhs) };
    let columns = (0..turned)
        .map(|column| solve_tied((turned..all).map(|row| response[row][column]).collect()))
        .collect::<Result<Vec<_>, _>>()?;
    let own = solve_tied(half_way[turned..].to_vec())?;
    let through = |row: usize, column: &[f64]| -> f64 {
        response[row][turned..].iter().zip(column).map(|(a, b)| a * b).sum()
    };
    let left: Vec<Vec<f64>> = (0..turned)
        .map(|row| {
            let entry = |column: usize| response[row][column] - through(row, &columns[column]);
            (0..turned).map(entry).collect()
        })
        .collect();
    let come: Vec<f64> = (0..turned).map(|row| half_way[row] - through(row, &own)).collect();

    let mut impulses = turn_together(&left, &come, corners)?;
    let answers = (0..all - turned).map(|other| {
        let passed: f64 = columns.iter().zip(&impulses).map(|(column, p)| column[other] * p).sum();
        -(2.0 * own[other] + passed)
    });
    let answers: Vec<f64> = answers.collect();
    impulses.extend(answers);
    Ok(impulses)
}

/// The impulses `P = γ J ½ (w⁻ + w⁺)` of several sliders that move each other, `w⁺ = w⁻ + W P`, with angles right to 1e-12, or as the last
/// correction leaves them.
fn turn_together(
    response: &[Vec<f64>],
    come: &[f64],
    corners: &[Corner],
) -> Result<Vec<f64>, LinearError> {
    let pair = |values: &[f64], at: usize| Vec2::new(values[2 * at], values[2 * at + 1]);
    let own = |at: usize| Response([0, 1].map(|row| pair(&response[2 * at + row], at)));
    let wanted = |(at, corner): (usize, &Corner)| own(at).angle(corner.comes, corner.goes);
    let wanted: Vec<f64> = corners.iter().enumerate().map(wanted).collect();
    let mut angles = wanted.clone();
    let mut impulses = vec![0.0; come.len()];
    for _ in 0..CORRECTIONS {
        let mut matrix = vec![vec![0.0; come.len()]; come.len()];
        let mut rhs = vec![0.0; come.len()];
        for (at, angle) in angles.iter().enumerate() {
            let own = own(at);
            let (sine, cosine) = sin_cos(0.5 * angle);
            let gyration = match own.is_one_way() {
                true => 0.0,
                false => 2.0 * sine / (cosine * own.determinant().sqrt()),
            };
            let w = perpendicular(pair(come, at)) * gyration;
            (rhs[2 * at], rhs[2 * at + 1]) = (w.x, w.y);
            for column in 0..come.len() {
                let moved = Vec2::new(response[2 * at][column], response[2 * at + 1][column]);
                let turned = perpendicular(moved) * (0.5 * gyration);
                (matrix[2 * at][column], matrix[2 * at + 1][column]) = (-turned.x, -turned.y);
            }
            matrix[2 * at][2 * at] += 1.0;
            matrix[2 * at + 1][2 * at + 1] += 1.0;
        }
        impulses = solve(&matrix, rhs)?;
        let mut is_right = true;
        for (at, angle) in angles.iter_mut().enumerate() {
            let change = |row: usize| -> f64 {
                response[row].iter().zip(&impulses).map(|(w, p)| w * p).sum()
            };
            let before = pair(come, at);
            let after = before + Vec2::new(change(2 * at), change(2 * at + 1));
            if own(at).is_one_way() || before == Vec2::zeros() {
                continue;
            }
            let off = own(at).angle(before, after) - wanted[at];
            is_right &= off.abs() <= RIGHT;
            *angle -= off;
        }
        if is_right {
            break;
        }
    }
    Ok(impulses)
}

/// Solves a few equations with a dense matrix.
fn solve(matrix: &[Vec<f64>], mut rhs: Vec<f64>) -> Result<Vec<f64>, LinearError> {
    let count = rhs.len();
    let mut dense = BandedMatrix::zeros(count, count - 1);
    for (row, entries) in matrix.iter().enumerate() {
        entries.iter().enumerate().for_each(|(column, entry)| dense.add(row, column, *entry));
    }
    dense.factorise()?.solve(&mut rhs);
    Ok(rhs)
}
