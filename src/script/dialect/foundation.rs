//! What the language takes over from Rhai, and what it refuses.
//!
//! Left out are Rhai's byte arrays and bit fields, which nothing here needs; its reflection, tags, `take` and JSON
//! parser; and `sleep`, which no interrupt could end. Where people would look for a function that is not here, or
//! Rhai's means something that surprises, the refusal says what to write.

use std::any::TypeId;

use rhai::packages::{
    ArithmeticPackage, BasicArrayPackage, BasicFnPackage, BasicIteratorPackage, BasicMapPackage,
    BasicMathPackage, BasicStringPackage, BasicTimePackage, LogicPackage, MoreStringPackage,
    Package,
};
use rhai::{Dynamic, Engine, EvalAltResult, ImmutableString};

use crate::script::messages::error::ScriptError;

rhai::def_package! {
    /// What the language takes over from Rhai.
    FromRhai(_module): ArithmeticPackage, BasicArrayPackage, BasicFnPackage, BasicIteratorPackage, BasicMapPackage,
        BasicMathPackage, BasicStringPackage, BasicTimePackage, LogicPackage, MoreStringPackage {}
}

/// What Rhai hashes names with. It makes the names of functions without one of hashes as well (`anon$…`), which a script can print; left
/// alone it would draw a seed at random for every process.
const SEED: [u64; 4] =
    [0x7769_7468_7920_0001, 0x7769_7468_7920_0002, 0x7769_7468_7920_0003, 0x7769_7468_7920_0004];

/// Texts that are kept once, however often they occur.
const TEXTS_SHARED: usize = 256;

/// A function of Rhai that is not to be used in the language.
pub struct Refused {
    /// The name of the function that is refused.
    pub name: &'static str,
    /// The counts of arguments that the refused function would have.
    pub counts: &'static [usize],
    /// The reason why the function is refused.
    pub reason: &'static str,
    /// What to write instead of the refused function.
    pub instead: &'static str,
}

/// All functions of Rhai that the language refuses.
pub const REFUSED: &[Refused] = &[
    Refused {
        name: "exit",
        counts: &[0, 1],
        // Rhai's would end a script as if all were well, its later checks unjudged.
        reason: "a script cannot leave with exit()",
        instead: "throw \"reason\" ends it with an error; check(…) decides the exit code",
    },
    Refused {
        name: "sleep",
        counts: &[1],
        reason: "a script cannot sleep",
        instead: "time in a simulation passes with sim.run_to(t), not on the clock",
    },
    Refused {
        name: "log",
        counts: &[1],
        reason: "log(x) could mean several things",
        instead: "write ln(x), log10(x), log2(x) or log(x, base)",
    },
    Refused {
        name: "atan",
        counts: &[2],
        reason: "the angle of a vector is atan2",
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
        reason: "there are no byte arrays here",
        instead: "text.to_chars() gives the characters",
    },
];

/// An engine with what the language takes over from Rhai, and nothing else.
pub fn engine() -> Engine {
    // It can be set once in a process: all engines but the first find it set.
    let _ = rhai::config::hashing::set_hashing_seed(Some(SEED));
    let mut engine = Engine::new_raw();
    engine.set_max_strings_interned(TEXTS_SHARED);
    engine.register_global_module(FromRhai::new().as_shared_module());
    // Text made into code has no lines to point at, and nothing here needs it.
    engine.disable_symbol("eval");
    for refused in REFUSED {
        for count in refused.counts {
            refuse(&mut engine, refused, *count);
        }
    }
    engine
}

fn refuse(engine: &mut Engine, refused: &'static Refused, count: usize) {
    // Rhai has some of these for exact types, which would win over those for any type.
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
