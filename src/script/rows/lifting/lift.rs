//! A call, made as often as there are variants of what it depends on.

use std::rc::Rc;

use rhai::Dynamic;

use super::family::{Family, Within, of_thing, present, take_lost};
use super::gather::gather;
use super::policy::Lifting;
use super::varied::{Varied, family_of, lost_in, project};
use crate::script::rows::kind::Kind;
use crate::script::rows::parameter::Parameter;
use crate::script::rows::table::{Form, Row};
use crate::script::words::error::{Place, ScriptError};

/// Makes a call of a row.
type Make<'m> = &'m mut dyn FnMut(Option<&mut Dynamic>, &[Dynamic]) -> Result<Dynamic, ScriptError>;

/// Makes a call of a row for each variant of what its receiver and its arguments depend on, as the row's domain wants it.
///
/// # Errors
/// Those of the call; also where derivatives would be lost, and where parameters of two scenes meet.
pub fn lift(
    (row, lifting): (&Row, Lifting),
    mut receiver: Option<&mut Dynamic>,
    (parameters, given): (&[Parameter], Vec<Dynamic>),
    make: Make<'_>,
) -> Result<Dynamic, ScriptError> {
    if let Some(present) = present() {
        let given: Vec<Dynamic> = given.iter().map(|of| project(of, present.variant)).collect();
        return make(receiver, &given);
    }
    let Some(family) = families(receiver.as_deref(), &given)? else {
        return make(receiver, &given);
    };
    let depends = given.iter().position(|of| family_of(of).is_some());
    match (lifting, depends) {
        (Lifting::Each, _) => {}
        (Lifting::AtValues, _) => {
            let given: Vec<Dynamic> = given.iter().map(|of| project(of, 0)).collect();
            return make(receiver, &given);
        }
        (Lifting::Once, None) => return make(receiver, &given),
        (Lifting::Once, Some(_)) if row.receiver().is_none() && is_about_derivatives(row) => {
            return make(receiver, &given);
        }
        (Lifting::Once, Some(at)) => {
            let name = parameters.get(at).map_or("", |of| of.name);
            let told = format!("{}: '{name}' may not depend on parameters of a scene", row.name);
            let hint = "value_of(x) is the number without its derivatives";
            return Err(ScriptError::new(told).hint(hint).at(Place::Argument(at)));
        }
        (Lifting::Refused, _) => {
            let told = format!("{} does not follow parameters of a scene", row.name);
            let hint = "build the scene with plain numbers in the place of scene.parameter(…), twice, and take the difference";
            return Err(ScriptError::new(told).hint(hint));
        }
    }
    let is_set = matches!(row.form, Form::Property(_)) && !given.is_empty();
    if is_set && receiver.as_deref().and_then(of_thing).is_none() {
        let told = format!("'{}' is set to something that depends on parameters", row.name);
        return Err(ScriptError::new(told).hint("make a new value: vec(x, y)"));
    }
    family.use_variants();
    let is_varied = receiver.as_deref().is_some_and(|held| held.is::<Varied>());
    let mut lost = given.iter().chain(receiver.as_deref()).find_map(lost_in);
    let _: Option<Rc<str>> = take_lost();
    let mut results = Vec::with_capacity(family.variants());
    // The one at the values last: a scene begins to have variants as it was before.
    for variant in (0..family.variants()).rev() {
        let within = Within::of(&family, variant);
        let given: Vec<Dynamic> = given.iter().map(|of| project(of, variant)).collect();
        let made = match &mut receiver {
            Some(held) if is_varied => make(Some(&mut project(held, variant)), &given),
            Some(held) => make(Some(held), &given),
            None => make(None, &given),
        };
        drop(within);
        results.push(made?);
    }
    results.reverse();
    lost = lost.or_else(take_lost);
    let is_thing = |value: &Dynamic| !value.is::<Varied>() && of_thing(value).is_some();
    gather(&family, &results, lost.as_ref(), &is_thing)
}

/// Whether a function takes values with their derivatives as they are.
fn is_about_derivatives(row: &Row) -> bool {
    row.parameters.first().is_some_and(|of| matches!(of.kind, Kind::Anything))
}

/// The parameters that a call depends on.
fn families(
    receiver: Option<&Dynamic>,
    given: &[Dynamic],
) -> Result<Option<Rc<Family>>, ScriptError> {
    let values: Vec<&Dynamic> = receiver.into_iter().chain(given).collect();
    Family::common(&values)
}

impl Family {
    /// The parameters that some values depend on, if any does.
    ///
    /// # Errors
    /// When they depend on those of two scenes.
    pub fn common(values: &[&Dynamic]) -> Result<Option<Rc<Self>>, ScriptError> {
        let own = |value: &&Dynamic| family_of(value).or_else(|| of_thing(value));
        let mut found: Option<Rc<Self>> = None;
        for family in values.iter().filter_map(own) {
            match &found {
                Some(known) if !Rc::ptr_eq(known, &family) => {
                    let names = [known, &family].map(|of| {
                        let names =
                            of.parameters().into_iter().map(|(name, _)| format!("'{name}'"));
                        names.collect::<Vec<_>>().join(", ")
                    });
                    let told =
                        format!("parameters of two scenes meet: {} and {}", names[0], names[1]);
                    let hint = "take value_of(x) of the one whose derivatives are not wanted";
                    return Err(ScriptError::new(told).hint(hint));
                }
                _ => found = Some(family),
            }
        }
        Ok(found)
    }
}

/// One value of what was made of some values in each variant.
///
/// # Errors
/// When arrays or maps differ in more than numbers.
pub fn gathered(
    family: &Rc<Family>,
    results: &[Dynamic],
    from: &[&Dynamic],
) -> Result<Dynamic, ScriptError> {
    family.use_variants();
    let lost = from.iter().find_map(|value| lost_in(value));
    gather(family, results, lost.as_ref(), &|_| false)
}
