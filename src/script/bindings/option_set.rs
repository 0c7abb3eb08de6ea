//! Typed option maps: one declaration defines the keys and the fields for their values.

use rhai::{Array, Dynamic, FnPtr};

use super::arguments::Arguments;
use super::parameter::Parameter;
use crate::integrators::Method;
use crate::script::messages::error::ScriptError;

pub trait FromOption: Sized {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError>;
}

/// Optional key without a default.
impl<T: FromOption> FromOption for Option<T> {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
        options.has(key).then(|| T::read(options, key)).transpose()
    }
}

impl FromOption for f64 {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
        options.number(key)
    }
}

impl FromOption for usize {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
        options.count(key)
    }
}

impl FromOption for String {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
        Ok(options.text(key)?.into())
    }
}

impl FromOption for Dynamic {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
        options.value(key)
    }
}

/// Implements [`FromOption`] for types that checked options contain in this form.
macro_rules! held_as_they_are {
    ($($held:ty),*) => {
        $(impl FromOption for $held {
            fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
                options.get(key)
            }
        })*
    };
}

held_as_they_are!(FnPtr, Array, Vec<f64>, Method);

/// Declares a struct whose fields `field: Type = parameter` are the keys of an option map.
///
/// The constant `KEYS` contains the keys in the order of the fields. The function `of` reads the struct from checked options.
macro_rules! option_set {
    (
        $(#[$about:meta])*
        $visible:vis struct $name:ident {
            $($(#[$meaning:meta])* $field:ident: $kind:ty = $key:expr,)*
        }
    ) => {
        $(#[$about])*
        $visible struct $name {
            $($(#[$meaning])* pub $field: $kind,)*
        }

        impl $name {
            /// Keys of the option map, in the order of the help text.
            pub const KEYS: &'static [$crate::script::bindings::parameter::Parameter] = &[$($key),*];

            /// Reads the fields from checked options.
            ///
            /// # Errors
            /// Fails if the type of a key is not that of its field, which is an internal error.
            pub fn of(
                options: &$crate::script::bindings::options::Options,
            ) -> Result<Self, $crate::script::messages::error::ScriptError> {
                Ok(Self {
                    $($field: {
                        const KEY: $crate::script::bindings::parameter::Parameter = $key;
                        $crate::script::bindings::option_set::FromOption::read(options, KEY.name)?
                    },)*
                })
            }
        }
    };
}

pub(in crate::script) use option_set;

/// Combines two sets of keys; `N` is the number of all keys.
pub const fn both<const N: usize>(
    first: &'static [Parameter],
    second: &'static [Parameter],
) -> [Parameter; N] {
    assert!(first.len() + second.len() == N);
    let mut keys = [first[0]; N];
    let mut at = 0;
    while at < N {
        keys[at] = if at < first.len() { first[at] } else { second[at - first.len()] };
        at += 1;
    }
    keys
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::bindings::options::Options;
    use crate::script::bindings::parameter::{Presence, integer, number, text};

    option_set! {
        struct GeneratedFields {
            width: f64 = number("width").or(Presence::Number(2.0)),
            count: usize = integer("count").or(Presence::Integer(3)),
            title: Option<String> = text("title").optional(),
        }
    }

    option_set! {
        struct FieldError {
            width: String = number("width").or(Presence::Number(2.0)),
        }
    }

    #[test]
    fn omitted_options_have_their_default_or_are_none() {
        let drawn =
            GeneratedFields::of(&Options::defaults(GeneratedFields::KEYS)).expect("the defaults");
        assert_eq!((drawn.width, drawn.count, drawn.title), (2.0, 3, None));
        let wrong = FieldError::of(&Options::defaults(FieldError::KEYS)).map(|wrong| wrong.width);
        assert!(matches!(wrong, Err(ScriptError::Internal(_))), "{wrong:?}");
    }

    #[test]
    fn combined_option_sets_list_both_key_sets_in_order() {
        const BOTH: [Parameter; 4] = both(GeneratedFields::KEYS, FieldError::KEYS);
        assert_eq!(BOTH.map(|key| key.name), ["width", "count", "title", "width"]);
    }
}
