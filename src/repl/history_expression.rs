//! Evaluation of an expression at all earlier states of a simulation, restored from snapshots or computed again in a copy.

use rhai::Dynamic;

use super::curves::{PlotShape, shape};
use super::session::{Reply, Rounds};
use super::shell::{CommandOutcome, Shell};
use crate::output::significant;
use crate::script::diagnose::Diagnostic;
use crate::script::handles::simulation::{Revisit, SimulationHandle};
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;

/// Largest number of states at which an expression is evaluated, sufficient for the resolution of a terminal.
const MOST_STATES: usize = 1000;

const DIGITS: usize = 6;

pub struct Followed {
    pub points: Vec<(f64, PlotShape)>,
    pub text: String,
}

/// Evaluates an expression at earlier states of a simulation that can be restored, without changing the simulation.
/// Of more than [`MOST_STATES`] states, an evenly distributed part is used.
///
/// # Errors
/// Fails if the expression fails, is interrupted, or advances or rewinds the simulation. The error has already been printed.
pub fn evaluate_history(
    shell: &mut Shell,
    subject: &SimulationHandle,
    text: &str,
) -> Result<Followed, CommandOutcome> {
    let kept = subject.simulation().stored_states();
    if kept.first().is_some_and(|(first, _)| *first > 0)
        && let Some(followed) = evaluate_rerun(shell, subject, text)?
    {
        return Ok(followed);
    }
    evaluate_snapshots(shell, subject, text, &kept)
}

/// Evaluates the expression at the stored snapshots, from the last to the first.
fn evaluate_snapshots(
    shell: &mut Shell,
    subject: &SimulationHandle,
    text: &str,
    kept: &[(usize, f64)],
) -> Result<Followed, CommandOutcome> {
    let every = kept.len().div_ceil(MOST_STATES);
    let last = kept.len() - 1;
    let chosen = (0..kept.len()).rev().filter(|at| (last - at).is_multiple_of(every) || *at == 0);
    let steps: Vec<usize> = chosen.map(|at| kept[at].0).collect();
    let revisit = Revisit::at_present(subject).map_err(|error| shell.report_native_error(error))?;
    let playback = PlaybackStep::Back(steps.into_iter());
    let (mut points, _) = evaluate_at_states(shell, text, Visits::new(shell, revisit, playback))?;
    points.reverse();
    let time = |at: usize| significant(kept[at].1, DIGITS);
    let what = match (kept[0].0, points.len() == kept.len()) {
        (0, true) => format!("all {} states", kept.len()),
        (0, false) => format!("{} of the {} states", points.len(), kept.len()),
        (_, true) => format!("the last {} states", kept.len()),
        (_, false) => format!("{} of the last {} states", points.len(), kept.len()),
    };
    let more = match kept[0].0 {
        0 => "",
        _ => "; earlier ones were discarded (withy repl --snapshots MB keeps more)",
    };
    let name = subject.name();
    let span = format!("t = {} to {}", time(0), time(last));
    let words = format!("evaluated in {what} of simulation '{name}', {span}{more}");
    Ok(Followed { points, text: words })
}

/// Evaluates the expression at rows of the history by repeating the run; `None` if the repeated run differs from the original.
fn evaluate_rerun(
    shell: &mut Shell,
    subject: &SimulationHandle,
    text: &str,
) -> Result<Option<Followed>, CommandOutcome> {
    let rows = subject.simulation().history().samples().len();
    let revisit = Revisit::at_start(subject).map_err(|error| shell.report_native_error(error))?;
    let playback = PlaybackStep::NextRow { next: 0, rows, every: rows.div_ceil(MOST_STATES) };
    let (points, other) = evaluate_at_states(shell, text, Visits::new(shell, revisit, playback))?;
    if let Some(why) = other {
        shell.print_note(&format!(
            "note: the first snapshots of simulation '{}' were discarded, and {why}",
            subject.name()
        ));
        return Ok(None);
    }
    let words = format!(
        "evaluated in {} of the {rows} rows of simulation '{}'. Its first snapshots were discarded, so the run was repeated in a copy, with identical energies and momenta in each row",
        points.len(),
        subject.name(),
    );
    Ok(Some(Followed { points, text: words }))
}

enum PlaybackStep {
    Back(std::vec::IntoIter<usize>),
    /// Every `every`-th row of the history, reached by repeating the run.
    NextRow {
        next: usize,
        rows: usize,
        every: usize,
    },
}

enum PlaybackError {
    Moves,
    Refused(ScriptError),
    Another(String),
    NoPoint(String),
}

struct Visits {
    revisit: Revisit,
    step: PlaybackStep,
    context: Context,
    position: (usize, f64),
    points: Vec<(f64, PlotShape)>,
    error: Option<PlaybackError>,
}

impl Visits {
    fn new(shell: &Shell, revisit: Revisit, step: PlaybackStep) -> Self {
        let (context, position) = (shell.session().context().clone(), revisit.place());
        Self { revisit, step, context, position, points: Vec::new(), error: None }
    }

    fn next_state(&mut self) -> Result<bool, PlaybackError> {
        self.context.proceed().map_err(PlaybackError::Refused)?;
        match &mut self.step {
            PlaybackStep::Back(steps) => match steps.next() {
                Some(to) => self.revisit.restore_step(to).map_err(PlaybackError::Refused),
                None => Ok(false),
            },
            PlaybackStep::NextRow { next, rows, every } => loop {
                let row = *next;
                if row >= *rows {
                    return Ok(false);
                }
                *next += 1;
                match self.revisit.run_again(row, &self.context) {
                    Ok(true) => (),
                    Ok(false) => {
                        let time = significant(self.revisit.place().1, DIGITS);
                        let message = format!("the repeated run differs at t = {time}");
                        return Err(PlaybackError::Another(message));
                    }
                    Err(stopped @ ScriptError::Stopped(_)) => {
                        return Err(PlaybackError::Refused(stopped));
                    }
                    Err(_) => {
                        let message = "the repeated run fails";
                        return Err(PlaybackError::Another(message.into()));
                    }
                }
                if row.is_multiple_of(*every) || row + 1 == *rows {
                    return Ok(true);
                }
            },
        }
    }
}

impl Rounds for Visits {
    fn begin(&mut self) -> bool {
        if self.error.is_some() {
            return false;
        }
        let goes_on = self.next_state().unwrap_or_else(|error| {
            self.error = Some(error);
            false
        });
        self.position = self.revisit.place();
        goes_on
    }

    fn end(&mut self, value: Dynamic) {
        if self.revisit.place() != self.position {
            self.error = Some(PlaybackError::Moves);
        }
        match shape(&value, "something else") {
            point @ (PlotShape::Number(_) | PlotShape::Vector(_)) => {
                self.points.push((self.position.1, point))
            }
            PlotShape::Whole(..) => {
                self.error = Some(PlaybackError::NoPoint("it is an array".into()))
            }
            PlotShape::None(why) => self.error = Some(PlaybackError::NoPoint(why)),
        }
    }
}

type Values = (Vec<(f64, PlotShape)>, Option<String>);

fn evaluate_at_states(
    shell: &mut Shell,
    text: &str,
    mut visits: Visits,
) -> Result<Values, CommandOutcome> {
    let reply = shell.session_mut().evaluate_repeatedly(text, &mut visits);
    let Visits { revisit, points, error, position: place, .. } = visits;
    drop(revisit);
    let at = format!("at t = {}", significant(place.1, DIGITS));
    match (reply, error) {
        (Err(Reply::Failed(why)), _) => {
            shell.print_note(&format!("'{text}' fails {at}:"));
            Err(shell.report_error(&why))
        }
        (Err(stopped), _) => Err(shell.print_reply(stopped)),
        (Ok(()), None) => Ok((points, None)),
        (Ok(()), Some(PlaybackError::Another(why))) => Ok((points, Some(why))),
        (Ok(()), Some(PlaybackError::Moves)) => Err(shell.report_error(&moves(text))),
        (Ok(()), Some(PlaybackError::Refused(error))) => Err(shell.report_native_error(error)),
        (Ok(()), Some(PlaybackError::NoPoint(why))) => {
            let message = Diagnostic::general(format!("'{text}' cannot be plotted {at}: {why}"));
            Err(shell
                .report_error(&message.with_hint("it must be a number, or a vector, at all times")))
        }
    }
}

pub fn moves(text: &str) -> Diagnostic {
    Diagnostic::general(format!("'{text}' advances a simulation"))
        .with_hint("plot an expression that changes nothing; the simulation was not changed")
}
