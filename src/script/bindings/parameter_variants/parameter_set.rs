//! Set of the parameters of a scene, each with two variants: its value plus and minus a perturbation.

use std::any::TypeId;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

use rhai::Dynamic;

use super::variant_value::VariantValue;
use crate::output::significant;
use crate::script::messages::error::{CallPart, ScriptError};

/// Default perturbation `p` of a parameter, as a fraction of its value.
/// The relative error of a difference quotient is about `p²` plus the relative rounding error over `p`.
pub const RELATIVE_DISTANCE: f64 = 1e-5;

/// Parameters of a scene. The unperturbed variant has the given values.
/// Variants 1 and 2 increase and decrease the first parameter, variants 3 and 4 the second, and so on.
#[derive(Default)]
pub struct ParameterSet {
    parameters: RefCell<Vec<DeclaredParameter>>,
    /// True if variants have been used, so that no parameter may be added.
    is_in_use: Cell<bool>,
    reported: RefCell<BTreeSet<(usize, usize)>>,
}

#[derive(Clone)]
struct DeclaredParameter {
    name: String,
    distance: f64,
}

#[derive(Clone)]
pub struct CurrentVariant {
    pub family: Rc<ParameterSet>,
    pub variant: usize,
}

thread_local! {
    static ANY: Cell<bool> = const { Cell::new(false) };
    static THINGS: RefCell<HashMap<TypeId, (&'static str, SceneParameters)>> = RefCell::default();
    static PRESENT: RefCell<Option<CurrentVariant>> = const { RefCell::new(None) };
    /// Reason why the call that is being evaluated has no results in perturbed variants; `None` if it has such results.
    static LOST: RefCell<Option<Rc<str>>> = const { RefCell::new(None) };
}

type SceneParameters = fn(&Dynamic) -> Option<Rc<ParameterSet>>;

pub fn register_type(id: TypeId, name: &'static str, family_of: SceneParameters) {
    THINGS.with_borrow_mut(|known| {
        known.insert(id, (name, family_of));
    });
}

pub(super) fn name_of(value: &Dynamic) -> Option<&'static str> {
    THINGS.with_borrow(|known| known.get(&value.type_id()).map(|(name, _)| *name))
}

pub(super) fn of_thing(value: &Dynamic) -> Option<Rc<ParameterSet>> {
    let known = THINGS.with_borrow(|known| known.get(&value.type_id()).copied());
    known.and_then(|(_, family_of)| family_of(value))
}

/// Variant in which a call is being evaluated; `None` if no call is being evaluated in variants.
pub fn present() -> Option<CurrentVariant> {
    PRESENT.with_borrow(Clone::clone)
}

pub fn present_variant() -> usize {
    present().map_or(0, |present| present.variant)
}

pub fn set_unavailable(reason: &str) {
    LOST.set(Some(reason.into()));
}

pub(super) fn take_unavailable() -> Option<Rc<str>> {
    LOST.take()
}

pub(super) struct VariantGuard;

impl VariantGuard {
    pub(super) fn of(family: &Rc<ParameterSet>, variant: usize) -> Self {
        PRESENT.set(Some(CurrentVariant { family: Rc::clone(family), variant }));
        Self
    }
}

impl Drop for VariantGuard {
    fn drop(&mut self) {
        PRESENT.set(None);
    }
}

impl ParameterSet {
    pub fn new() -> Rc<Self> {
        ANY.set(true);
        Rc::default()
    }

    /// Returns true if a parameter set has been created, so that values may have variants.
    pub fn is_any() -> bool {
        ANY.get()
    }

    /// Adds a parameter with its value and an optional perturbation. Returns the value of the parameter in all variants.
    ///
    /// # Errors
    /// Fails if the name is already used, or if variants have been used.
    pub fn declare(
        self: &Rc<Self>,
        name: &str,
        value: f64,
        distance: Option<f64>,
    ) -> Result<VariantValue, ScriptError> {
        if self.number_of(name).is_some() {
            let reported = format!("the parameter '{name}' already exists");
            let hint = "store the number that scene.parameter returns in a variable and use it, or \
                choose another name";
            return Err(ScriptError::new(reported).hint(hint).at(CallPart::Argument(0)));
        }
        if self.is_in_use.get() {
            let reported = format!(
                "the parameter '{name}' is declared after other parameters of its scene were \
                used"
            );
            let hint = "declare all parameters of a scene first";
            return Err(ScriptError::new(reported).hint(hint).at(CallPart::Argument(0)));
        }
        let size = if value == 0.0 { 1.0 } else { value.abs() };
        let distance = distance.unwrap_or(RELATIVE_DISTANCE * size);
        // The perturbation is rounded so that adding it to the value causes no rounding error.
        let distance = 0.5 * ((value + distance) - (value - distance));
        let mut values = vec![Dynamic::from(value); self.variants()];
        values.extend([value + distance, value - distance].map(Dynamic::from));
        self.parameters.borrow_mut().push(DeclaredParameter { name: name.to_owned(), distance });
        Ok(VariantValue::new(self, values, None))
    }

    pub fn is_first_report(&self, line: usize, column: usize) -> bool {
        self.reported.borrow_mut().insert((line, column))
    }

    /// Returns true if a function of the scene branches on a parameter, so that derivatives may be wrong.
    pub fn branches_on_parameter(&self) -> bool {
        !self.reported.borrow().is_empty()
    }

    /// Records that variants are used, so that no further parameters may be added.
    pub fn use_variants(&self) {
        self.is_in_use.set(true);
    }

    pub fn variants(&self) -> usize {
        1 + 2 * self.parameters.borrow().len()
    }

    pub fn parameters(&self) -> Vec<(String, f64)> {
        let parameters = self.parameters.borrow();
        parameters.iter().map(|of| (of.name.clone(), of.distance)).collect()
    }

    pub fn distance(&self, parameter: usize) -> Option<f64> {
        self.parameters.borrow().get(parameter).map(|of| of.distance)
    }

    pub fn number_of(&self, name: &str) -> Option<usize> {
        self.parameters.borrow().iter().position(|of| of.name == name)
    }

    /// Index of the parameter that a variant perturbs, and true for a positive perturbation; `None` for the unperturbed variant.
    pub fn side_of_variant(variant: usize) -> Option<(usize, bool)> {
        let beside = variant.checked_sub(1)?;
        Some((beside / 2, beside % 2 == 0))
    }

    /// Description of a variant, for example `'EI' plus 1e-3`; empty for the unperturbed variant.
    pub fn describe(&self, variant: usize) -> String {
        let parameters = self.parameters.borrow();
        let of =
            Self::side_of_variant(variant).and_then(|(at, plus)| Some((parameters.get(at)?, plus)));
        of.map_or_else(String::new, |(of, plus)| {
            let distance = significant(of.distance, 3);
            format!("'{}' {} {distance}", of.name, if plus { "plus" } else { "minus" })
        })
    }
}
