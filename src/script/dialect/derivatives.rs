//! Operators on numbers and vectors that depend on parameters of a scene.
//! The operators are evaluated for the given parameters and for each perturbation of a parameter.

use std::any::TypeId;
use std::rc::Rc;

use rhai::{Dynamic, Engine, NativeCallContext};

use crate::elementary::power;
use crate::script::bindings::parameter_variants::{
    NonsmoothCheck, ParameterSet, VariantValue, at_multiples, combined,
    combined_without_derivatives, corner_of, near_zero_base, near_zero_divisor, present,
    present_variant,
};
use crate::script::messages::error::{EngineResult, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::script::source::syntax::{LONGEST_CHAIN, OWN, power_name};

#[derive(Clone, Copy)]
struct OnNumbers {
    of: fn(f64, f64) -> f64,
    corner: Option<NonsmoothCheck>,
}

impl OnNumbers {
    const fn smooth(of: fn(f64, f64) -> f64) -> Self {
        Self { of, corner: None }
    }

    const fn nonsmooth(of: fn(f64, f64) -> f64, corner: NonsmoothCheck) -> Self {
        Self { of, corner: Some(corner) }
    }
}

pub fn install(engine: &mut Engine) {
    let arithmetic: [(String, OnNumbers); 5] = [
        ("+".into(), OnNumbers::smooth(|x, y| x + y)),
        ("-".into(), OnNumbers::smooth(|x, y| x - y)),
        ("*".into(), OnNumbers::smooth(|x, y| x * y)),
        ("%".into(), OnNumbers::nonsmooth(|x, y| x % y, at_multiples)),
        (format!("{OWN}/"), OnNumbers::nonsmooth(|x, y| x / y, near_zero_divisor)),
    ];
    let raised = OnNumbers::nonsmooth(power, near_zero_base);
    let powers = (0..LONGEST_CHAIN).map(|chain| (power_name(chain), raised));
    for (name, numbers) in arithmetic.into_iter().chain(powers) {
        for types in with_one() {
            let own = name.clone();
            engine.register_raw_fn(&name, types, move |context: NativeCallContext, operands| {
                in_each(&context, &own, numbers, operands)
            });
        }
    }
    let varied = [TypeId::of::<VariantValue>()];
    engine.register_raw_fn("-", varied, |context: NativeCallContext, operands| {
        let mut values = vec![&mut *operands[0]];
        let mut minus = Dynamic::from(-1.0);
        values.push(&mut minus);
        in_each(&context, "*", OnNumbers::smooth(|x, y| x * y), &mut values)
    });
    engine.register_raw_fn("+", varied, |_, operands| -> EngineResult<Dynamic> {
        Ok(operands[0].clone())
    });
    engine.register_fn("to_float", |number: VariantValue| number);
    for name in ["to_int", "sign", "is_zero", "is_even", "is_odd"] {
        engine.register_raw_fn(name, varied, move |context: NativeCallContext, operands| {
            let mut number = VariantValue::project(operands[0], present_variant());
            context.call_native_fn_raw(name, true, &mut [&mut number])
        });
    }
    for symbol in ["<", ">", "<=", ">=", "==", "!="] {
        for name in [symbol.to_owned(), format!("{OWN}{symbol}")] {
            for types in with_one() {
                let own = name.clone();
                engine.register_raw_fn(
                    &name,
                    types,
                    move |context: NativeCallContext, operands| {
                        let [left, right] = operands else { return Ok(Dynamic::UNIT) };
                        let at = present_variant();
                        let [mut left, mut right] =
                            [left, right].map(|of| VariantValue::project(of, at));
                        context.call_native_fn_raw(&own, false, &mut [&mut left, &mut right])
                    },
                );
            }
        }
    }
}

fn with_one() -> [[TypeId; 2]; 3] {
    let (varied, any) = (TypeId::of::<VariantValue>(), TypeId::of::<Dynamic>());
    [[varied, varied], [varied, any], [any, varied]]
}

fn in_each(
    context: &NativeCallContext,
    name: &str,
    numbers: OnNumbers,
    operands: &mut [&mut Dynamic],
) -> EngineResult<Dynamic> {
    let [left, right] = operands else { return Ok(Dynamic::UNIT) };
    let (left, right) = ((**left).clone().flatten(), (**right).clone().flatten());
    let at = |variant: usize| -> EngineResult<Dynamic> {
        let [mut left, mut right] = [&left, &right].map(|of| VariantValue::project(of, variant));
        match (as_number(&left), as_number(&right)) {
            (Some(left), Some(right)) => Ok((numbers.of)(left, right).into()),
            _ => context.call_native_fn_raw(name, false, &mut [&mut left, &mut right]),
        }
    };
    if let Some(present) = present() {
        return at(present.variant);
    }
    let position = context.call_position();
    let found = ParameterSet::common(&[&left, &right]);
    let family: Rc<ParameterSet> = match found.map_err(|error| error.into_engine(position))? {
        Some(family) => family,
        None => return at(0),
    };
    let all = (0..family.variants()).map(at).collect::<EngineResult<Vec<_>>>()?;
    let given = [left, right];
    let sign = name.trim_start_matches(OWN).trim_end_matches(|of: char| of.is_ascii_digit());
    let corner = numbers.corner.and_then(|corner| corner_of((sign, corner), &family, &given));
    let gathered: Result<Dynamic, ScriptError> = match corner {
        Some(reason) => combined_without_derivatives(&family, &all, reason),
        None => combined(&family, &all, &[&given[0], &given[1]]),
    };
    gathered.map_err(|error| error.into_engine(position))
}
