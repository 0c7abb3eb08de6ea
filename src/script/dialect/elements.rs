//! Methods of arrays and maps that call a function for each element.
//! Unlike in Rhai, a test function must return a boolean, and `for_each` passes the element instead of the index.

use std::any::TypeId;
use std::cell::Cell;

use rhai::{Array, Dynamic, Engine, EvalAltResult, FnPtr, INT, Map, NativeCallContext, Position};

use crate::script::messages::error::{EngineResult, ScriptError};
use crate::script::messages::numbers::describe;

pub fn install(engine: &mut Engine) {
    install_searches(engine);
    install_sieves(engine);
    let types = [TypeId::of::<Array>(), TypeId::of::<FnPtr>()];
    engine.register_raw_fn("for_each", types, |native, values| -> EngineResult<()> {
        let function = function_of(values)?;
        let asked = ElementCallback::new(&native, &function);
        let Some(mut array) = values.first_mut().and_then(|array| array.write_lock::<Array>())
        else {
            return Ok(());
        };
        for (index, element) in array.iter_mut().enumerate() {
            let _ = asked.call_function(index, element)?;
        }
        Ok(())
    });
}

fn install_searches(engine: &mut Engine) {
    search(engine, "some", |_, found| found.is_some().into());
    search(engine, "index_of", |_, found| {
        found.map_or(-1, |index| INT::try_from(index).unwrap_or(INT::MAX)).into()
    });
    search(engine, "find", |array, found| {
        found.and_then(|index| array.get(index).cloned()).unwrap_or_default()
    });
    let types = [TypeId::of::<Array>(), TypeId::of::<FnPtr>()];
    engine.register_raw_fn("all", types, |native, values| -> EngineResult<bool> {
        let (mut array, test) = array_and_test(values)?;
        let asked = ElementCallback::new(&native, &test);
        for (index, element) in array.iter_mut().enumerate() {
            if !asked.test_element(index, element)? {
                return Ok(false);
            }
        }
        Ok(true)
    });
}

fn search(engine: &mut Engine, name: &str, give: fn(&Array, Option<usize>) -> Dynamic) {
    let types = [TypeId::of::<Array>(), TypeId::of::<FnPtr>(), TypeId::of::<INT>()];
    let least = if name == "some" { 2 } else { 3 };
    for count in 2..=least {
        engine.register_raw_fn(
            name,
            &types[..count],
            move |native, values| -> EngineResult<Dynamic> {
                let start = values.get(2).and_then(|start| start.as_int().ok()).unwrap_or(0);
                let (mut array, test) = array_and_test(values)?;
                let first = match usize::try_from(start) {
                    Ok(start) => start,
                    Err(_) => array.len().saturating_sub(start.unsigned_abs() as usize),
                };
                let asked = ElementCallback::new(&native, &test);
                let mut found = None;
                for (index, element) in array.iter_mut().enumerate().skip(first) {
                    if asked.test_element(index, element)? {
                        found = Some(index);
                        break;
                    }
                }
                Ok(give(&array, found))
            },
        );
    }
}

type Partition = fn(&NativeCallContext, &[&mut Dynamic]) -> EngineResult<(Dynamic, Dynamic)>;

fn install_sieves(engine: &mut Engine) {
    let kinds = [
        (TypeId::of::<Array>(), part_array as Partition),
        (TypeId::of::<Map>(), part_map as Partition),
    ];
    for (of, part) in kinds {
        let types = [of, TypeId::of::<FnPtr>()];
        engine.register_raw_fn("filter", types, move |native, values| -> EngineResult<Dynamic> {
            Ok(part(&native, values)?.0)
        });
        engine.register_raw_fn("drain", types, move |native, values| -> EngineResult<Dynamic> {
            let (passed, others) = part(&native, values)?;
            Ok(replace(values, others, passed))
        });
        engine.register_raw_fn("retain", types, move |native, values| -> EngineResult<Dynamic> {
            let (passed, others) = part(&native, values)?;
            Ok(replace(values, passed, others))
        });
    }
}

fn replace(values: &mut [&mut Dynamic], kept: Dynamic, given: Dynamic) -> Dynamic {
    if let Some(own) = values.first_mut() {
        **own = kept;
    }
    given
}

fn part_array(
    native: &NativeCallContext,
    values: &[&mut Dynamic],
) -> EngineResult<(Dynamic, Dynamic)> {
    let (array, test) = array_and_test(values)?;
    let asked = ElementCallback::new(native, &test);
    let (mut passed, mut others) = (Array::new(), Array::new());
    for (index, mut element) in array.into_iter().enumerate() {
        let is_passed = asked.test_element(index, &mut element)?;
        if is_passed { &mut passed } else { &mut others }.push(element);
    }
    Ok((passed.into(), others.into()))
}

fn part_map(
    native: &NativeCallContext,
    values: &[&mut Dynamic],
) -> EngineResult<(Dynamic, Dynamic)> {
    let map = values.first().and_then(|map| map.read_lock::<Map>());
    let map = map.map(|map| map.clone()).unwrap_or_default();
    let test = function_of(values)?;
    let (mut passed, mut others) = (Map::new(), Map::new());
    for (key, mut value) in map {
        let answer = test.call_raw_with_extra_args(
            test.fn_name(),
            native,
            Some(&mut value),
            [key.clone().into()],
            [],
            Some(1),
        )?;
        let is_passed = boolean_result(native, &answer)?;
        if is_passed { &mut passed } else { &mut others }.insert(key, value);
    }
    Ok((passed.into(), others.into()))
}

pub(super) fn array_of(values: &[&mut Dynamic]) -> Array {
    let array = values.first().and_then(|array| array.read_lock::<Array>());
    array.map(|array| array.clone()).unwrap_or_default()
}

fn array_and_test(values: &[&mut Dynamic]) -> EngineResult<(Array, FnPtr)> {
    Ok((array_of(values), function_of(values)?))
}

fn function_of(values: &[&mut Dynamic]) -> EngineResult<FnPtr> {
    let function = values.get(1).and_then(|function| (**function).clone().try_cast::<FnPtr>());
    function.ok_or_else(|| {
        ScriptError::internal_error("a test is no function").into_engine(Position::NONE)
    })
}

#[derive(Clone, Copy)]
enum CallbackArguments {
    Element,
    ElementAndIndex,
    ElementAsThis,
}

struct ElementCallback<'a> {
    native: &'a NativeCallContext<'a>,
    function: &'a FnPtr,
    given: Cell<Option<CallbackArguments>>,
}

impl<'a> ElementCallback<'a> {
    fn new(native: &'a NativeCallContext<'a>, function: &'a FnPtr) -> Self {
        Self { native, function, given: Cell::new(None) }
    }

    fn call_function(&self, index: usize, element: &mut Dynamic) -> EngineResult<Dynamic> {
        if let Some(given) = self.given.get() {
            return self.call(given, index, element);
        }
        let mut refused = None;
        for given in [
            CallbackArguments::Element,
            CallbackArguments::ElementAndIndex,
            CallbackArguments::ElementAsThis,
        ] {
            match self.call(given, index, element) {
                Err(error) if self.is_wrong_count(&error) => refused = refused.or(Some(error)),
                other => {
                    self.given.set(Some(given));
                    return other;
                }
            }
        }
        refused.map_or(Ok(Dynamic::UNIT), Err)
    }

    fn call(
        &self,
        given: CallbackArguments,
        index: usize,
        element: &mut Dynamic,
    ) -> EngineResult<Dynamic> {
        let copy = element.clone();
        let index = Dynamic::from(INT::try_from(index).unwrap_or(INT::MAX));
        let this = self.function.is_anonymous().then_some(&mut *element);
        match given {
            CallbackArguments::Element => self.function.call_raw(self.native, this, [copy]),
            CallbackArguments::ElementAndIndex => {
                self.function.call_raw(self.native, this, [copy, index])
            }
            CallbackArguments::ElementAsThis => {
                self.function.call_raw(self.native, Some(element), [])
            }
        }
    }

    fn is_wrong_count(&self, error: &EvalAltResult) -> bool {
        matches!(
            error,
            EvalAltResult::ErrorFunctionNotFound(signature, _)
                if signature.starts_with(self.function.fn_name())
        )
    }

    fn test_element(&self, index: usize, element: &mut Dynamic) -> EngineResult<bool> {
        boolean_result(self.native, &self.call_function(index, element)?)
    }
}

pub(super) fn boolean_result(native: &NativeCallContext, answer: &Dynamic) -> EngineResult<bool> {
    answer.as_bool().map_err(|_| {
        let got = describe(native.engine(), answer);
        let refusal = ScriptError::new(format!("a test must return true or false, got {got}"));
        refusal.hint("compare: |x| x % 2 == 1").into_engine(native.call_position())
    })
}
