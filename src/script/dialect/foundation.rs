//! Packages of Rhai that belong to the language, and functions that are rejected with a suggestion.
//! The language lacks byte arrays, bit fields, reflection, tags, the JSON parser and `take` of Rhai, and the uninterruptible `sleep`.

use std::any::TypeId;

use rhai::packages::{
    ArithmeticPackage, BasicArrayPackage, BasicFnPackage, BasicIteratorPackage, BasicMapPackage,
    BasicMathPackage, BasicStringPackage, BasicTimePackage, LogicPackage, MoreStringPackage,
    Package,
};
use rhai::{Dynamic, Engine, EvalAltResult, ImmutableString};

use crate::script::messages::error::ScriptError;

rhai::def_package! {
    FromRhai(_module): ArithmeticPackage, BasicArrayPackage, BasicFnPackage, BasicIteratorPackage, BasicMapPackage,
        BasicMathPackage, BasicStringPackage, BasicTimePackage, LogicPackage, MoreStringPackage {}
}

/// Fixed seed of the hashes in Rhai. Hashes are part of the names of closures (`anon$…`), which scripts can print.
const SEED: [u64; 4] =
    [0x7769_7468_7920_0001, 0x7769_7468_7920_0002, 0x7769_7468_7920_0003, 0x7769_7468_7920_0004];

const TEXTS_SHARED: usize = 256;

pub struct Refused {
    pub name: &'static str,
    pub counts: &'static [usize],
    pub reason: &'static str,
    pub instead: &'static str,
}

pub const REFUSED: &[Refused] = &[
    Refused {
        name: "exit",
        counts: &[0, 1],
        // Scripts must not call `exit` of Rhai, because they would end successfully without their remaining checks.
        reason: "a script cannot leave with exit()",
        instead: "throw \"reason\" ends it with an error; check(…) determines the exit code",
    },
    Refused {
        name: "sleep",
        counts: &[1],
        reason: "a script cannot sleep",
        instead: "sim.run_to(t) advances the time of a simulation; scripts have no clock",
    },
    Refused {
        name: "log",
        counts: &[1],
        reason: "log(x) is ambiguous",
        instead: "write ln(x), log10(x), log2(x) or log(x, base)",
    },
    Refused {
        name: "atan",
        counts: &[2],
        reason: "use atan2 for the angle of a vector",
        instead: "write atan2(y, x)",
    },
    Refused {
        name: "to_radians",
        counts: &[1],
        reason: "there is no function 'to_radians'",
        instead: "write radians(x)",
    },
    Refused {
        name: "to_degrees",
        counts: &[1],
        reason: "there is no function 'to_degrees'",
        instead: "write degrees(x)",
    },
    Refused {
        name: "PI",
        counts: &[0],
        reason: "PI is a constant, not a function",
        instead: "write PI",
    },
    Refused {
        name: "E",
        counts: &[0],
        reason: "E is a constant, not a function",
        instead: "write E",
    },
    Refused {
        name: "to_blob",
        counts: &[1],
        reason: "byte arrays are not available",
        instead: "text.to_chars() returns the characters",
    },
];

pub fn engine() -> Engine {
    // The seed of the hashes can be set once per process, so an error for later engines is ignored.
    let _ = rhai::config::hashing::set_hashing_seed(Some(SEED));
    let mut engine = Engine::new_raw();
    engine.set_max_strings_interned(TEXTS_SHARED);
    engine.register_global_module(FromRhai::new().as_shared_module());
    // The function `eval` is disabled, because code in strings has no line numbers.
    engine.disable_symbol("eval");
    for refused in REFUSED {
        for count in refused.counts {
            refuse(&mut engine, refused, *count);
        }
    }
    engine
}

fn refuse(engine: &mut Engine, refused: &'static Refused, count: usize) {
    // A rejection is also registered for exact types, because functions of Rhai for exact types take precedence.
    let mut types =
        vec![TypeId::of::<Dynamic>(), TypeId::of::<f64>(), TypeId::of::<ImmutableString>()];
    if count == 0 {
        types.truncate(1);
    }
    for of in types {
        engine.register_raw_fn(
            refused.name,
            vec![of; count],
            move |native, _| -> Result<Dynamic, Box<EvalAltResult>> {
                let error = ScriptError::new(refused.reason).hint(refused.instead);
                Err(error.into_engine(native.call_position()))
            },
        );
    }
}
