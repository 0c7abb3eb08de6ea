//! Schedules in stored form: terms in reverse Polish notation, which can be read without recursion.

use serde::ser::Error;
use serde::{Deserialize, Serialize, Serializer};

use super::schedule::MOST_PARTS;
use super::{LoadError, Operation, Schedule};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum StoredTerm {
    Constant(f64),
    Table(Vec<(f64, f64)>),
    Sine { amplitude: f64, rate: f64, phase: f64 },
    SmoothPulse { duration: f64 },
    Combine(Operation),
}

impl Schedule {
    /// Returns true if the schedule can be stored, that is, if it contains no script function and no controller.
    pub fn can_be_stored(&self) -> bool {
        self.append_terms(&mut Vec::new()).is_some()
    }

    fn append_terms(&self, terms: &mut Vec<StoredTerm>) -> Option<()> {
        let term = match self {
            Self::Constant(factor) => StoredTerm::Constant(*factor),
            Self::Table(rows) => StoredTerm::Table(rows.clone()),
            Self::Sine { amplitude, rate, phase } => {
                StoredTerm::Sine { amplitude: *amplitude, rate: *rate, phase: *phase }
            }
            Self::SmoothPulse { duration } => StoredTerm::SmoothPulse { duration: *duration },
            Self::Combined { operation, parts, .. } => {
                parts.0.append_terms(terms)?;
                parts.1.append_terms(terms)?;
                StoredTerm::Combine(*operation)
            }
            Self::Function { .. } | Self::Sampled(_) | Self::DigitalController { .. } => {
                return None;
            }
        };
        terms.push(term);
        Some(())
    }
}

/// Schedules that can be stored are equal if their terms are equal. A schedule with a script function or a controller differs from all others.
impl PartialEq for Schedule {
    fn eq(&self, other: &Self) -> bool {
        let [mut own, mut others] = [Vec::new(), Vec::new()];
        self.append_terms(&mut own).and(other.append_terms(&mut others)).is_some() && own == others
    }
}

impl Serialize for Schedule {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut terms = Vec::new();
        let stored = self.append_terms(&mut terms);
        stored.ok_or_else(|| S::Error::custom("a function cannot be stored"))?;
        terms.serialize(serializer)
    }
}

impl TryFrom<Vec<StoredTerm>> for Schedule {
    type Error = LoadError;

    fn try_from(terms: Vec<StoredTerm>) -> Result<Self, LoadError> {
        if terms.len() > 2 * MOST_PARTS {
            return Err(LoadError::TooManyParts { parts: terms.len() / 2, most: MOST_PARTS });
        }
        let mut made: Vec<Self> = Vec::new();
        for term in terms {
            let next = match term {
                StoredTerm::Constant(factor) => Self::constant(factor)?,
                StoredTerm::Table(rows) => Self::table(rows)?,
                StoredTerm::Sine { amplitude, rate, phase } => Self::sine(amplitude, rate, phase)?,
                StoredTerm::SmoothPulse { duration } => Self::smooth_pulse(duration)?,
                StoredTerm::Combine(operation) => {
                    let (Some(second), Some(first)) = (made.pop(), made.pop()) else {
                        return Err(LoadError::StoredTerms);
                    };
                    Self::combined(operation, first, second)?
                }
            };
            made.push(next);
        }
        match (made.pop(), made.is_empty()) {
            (Some(schedule), true) => Ok(schedule),
            _ => Err(LoadError::StoredTerms),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::rc::Rc;

    #[test]
    fn stored_schedule_is_restored_unchanged() {
        let product = |a, b| Schedule::combined(Operation::Product, a, b).unwrap();
        let parts =
            product(Schedule::hold_for(2.0).unwrap(), Schedule::sine(1.0, 2.0, 0.3).unwrap());
        let pulse = Schedule::smooth_pulse(1.5).unwrap();
        let schedule = Schedule::combined(Operation::Sum, parts, pulse).unwrap();
        let mut terms = Vec::new();
        schedule.append_terms(&mut terms).unwrap();
        assert_eq!(terms.len(), 5);
        let again = Schedule::try_from(terms).unwrap();
        assert_eq!(again.describe(), schedule.describe());
    }

    #[test]
    fn invalid_stored_terms_are_rejected() {
        let refused = |terms: Vec<StoredTerm>| Schedule::try_from(terms).unwrap_err();
        let (one, sum) = (StoredTerm::Constant(1.0), StoredTerm::Combine(Operation::Sum));
        assert_eq!(refused(vec![]), LoadError::StoredTerms);
        assert_eq!(refused(vec![one.clone(), one.clone()]), LoadError::StoredTerms);
        assert_eq!(refused(vec![one.clone(), sum.clone()]), LoadError::StoredTerms);
        assert!(matches!(refused(vec![one; 3000]), LoadError::TooManyParts { .. }));
        assert!(matches!(refused(vec![StoredTerm::Table(vec![])]), LoadError::ShortTable { .. }));
        let function = Schedule::Function {
            function: Rc::new(Ok::<f64, super::super::FunctionError>),
            breaks: vec![],
        };
        let both = Schedule::combined(Operation::Sum, function, Schedule::Constant(1.0)).unwrap();
        assert!(!both.can_be_stored());
    }
}
