//! Replacement of operators of Rhai before parsing, so that numbers behave as in scientific languages.
//!
//! The text is changed, because Rhai's comparisons and integer division ignore registered functions:
//! - The operators `/ << >> < > <= >= == !=` become `num/`, `num<`, … of the same precedence.
//! - Along a chain of powers, `^` and `**` become `num^0`, `num^1`, … with increasing precedence.
//!   Custom operators are left-associative, so a single power operator would evaluate `2^3^2` to 64.
//! - The expression `-x^2` is an error, because Rhai's minus binds tighter than any operator and would give the square of `-x`.
//! - The operators `/=`, `^=`, `**=`, `<<=` and `>>=` become two tokens (see [`mark`]).
//! - Loops get an additional statement (see `loop_scoping`).
//!
//! Functions of Rhai that are declared as subject to change are used only here and in `lexing`.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

use rhai::{Dynamic, Engine, LexError, Position, Token};

use super::text::Source;
use super::{loop_scoping, switch_rewrite};
use crate::script::messages::stop::Stop;

/// Prefix of the names of the operators that replace those of Rhai.
pub const OWN: &str = "num";

/// Comparison, division and shift operators that are replaced, with their precedences in Rhai.
pub const REPLACED: [(&str, u8); 9] = [
    ("<<", 210),
    (">>", 210),
    ("/", 180),
    ("<", 110),
    (">", 110),
    ("<=", 110),
    (">=", 110),
    ("==", 90),
    ("!=", 90),
];

/// Maximum number of operators in a chain of powers `a^b^c^…`.
pub const LONGEST_CHAIN: u8 = 16;

const POWER_PRECEDENCE: u8 = 190;

/// Private-use characters in the rewritten text of a script. In `x /= y`, for example, the operator is replaced by two tokens.
/// `DIVIDE_HALF` stands for the operator, and `OPERAND_HALF` encloses the operand `y` in a [`DivisionOperand`].
/// `^=` and `**=` are replaced by `POWER_HALF` and `OPERAND_HALF`, `<<=` by `UP_HALF` and `OPERAND_HALF`, and `>>=` by `DOWN_HALF` and `OPERAND_HALF`.
const DIVIDE_HALF: char = '\u{E000}';
const POWER_HALF: char = '\u{E001}';
const OPERAND_HALF: char = '\u{E002}';
const UP_HALF: char = '\u{E005}';
const DOWN_HALF: char = '\u{E006}';
const OPERAND: &str = "\u{E002}";

/// Operand `y` of `x /= y`, `x ^= y` and similar assignments, of a separate type, so that operators of Rhai do not apply.
#[derive(Clone)]
pub struct DivisionOperand(pub Dynamic);

/// Name of the power operator with the index `chain` in a chain of powers, such as `num^0`.
pub fn power_name(chain: u8) -> String {
    format!("{OWN}^{chain}")
}

#[derive(Clone, Default)]
pub struct TokenReader {
    nesting: Rc<RefCell<Nesting>>,
    stopped: Rc<Cell<Option<Stop>>>,
    is_undisturbed: Rc<Cell<bool>>,
}

impl TokenReader {
    /// Resets the state, because the previous text may have ended within an expression.
    pub fn begin(&self) {
        *self.nesting.borrow_mut() = Nesting::default();
        self.stopped.set(None);
    }

    /// Calls `work` with the interruption of parsing disabled. `work` must parse only texts that have been parsed before.
    pub fn undisturbed<T>(&self, work: impl FnOnce() -> T) -> T {
        let was_undisturbed = self.is_undisturbed.replace(true);
        let result = work();
        self.is_undisturbed.set(was_undisturbed);
        result
    }

    /// Reason why parsing was stopped; `None` if it was not stopped.
    pub fn stopped(&self) -> Option<Stop> {
        self.stopped.get()
    }
}

const PULSE: u32 = 64;

/// Registers the tokens of the language. `stop` returns a reason for stopping the parser, or `None` if the parser continues.
/// The returned reader must be reset with [`TokenReader::begin`] before each text.
pub fn install(
    engine: &mut Engine,
    stop: impl Fn() -> Option<Stop> + 'static,
) -> Result<TokenReader, String> {
    for (symbol, precedence) in REPLACED {
        engine.register_custom_operator(format!("{OWN}{symbol}"), precedence)?;
    }
    for chain in 0..LONGEST_CHAIN {
        engine.register_custom_operator(power_name(chain), POWER_PRECEDENCE + chain)?;
    }
    engine.register_custom_syntax_with_state_raw(
        OPERAND,
        |symbols, _, _| Ok((symbols.len() == 1).then(|| "$expr$".into())),
        false,
        |context, inputs, _| match inputs.first() {
            Some(expression) => context
                .eval_expression_tree(expression)
                .map(|value| Dynamic::from(DivisionOperand(value))),
            None => Ok(Dynamic::UNIT),
        },
    );
    loop_scoping::install(engine);
    let reader = TokenReader::default();
    let TokenReader { nesting, stopped, is_undisturbed } = reader.clone();
    let count = Cell::new(0_u32);
    // Rhai marks the hook as deprecated only because it may change.
    #[allow(deprecated)]
    engine.on_parse_token(move |token, _, _| {
        count.set(count.get().wrapping_add(1));
        if count.get().is_multiple_of(PULSE) && !is_undisturbed.get() {
            stopped.set(stopped.get().or_else(&stop));
        }
        match (stopped.get(), &token) {
            (None, _) => nesting.borrow_mut().map(token),
            // Within a string, the parser does not expect errors of the hook and would panic.
            (Some(_), Token::StringConstant(_) | Token::InterpolatedString(_)) => token,
            (Some(_), _) => refuse("the reading was stopped"),
        }
    });
    Ok(reader)
}

/// Rewrites `/=`, `^=`, `**=`, `<<=` and `>>=` to two tokens, and marks loop bodies and `switch` expressions.
/// Columns are unchanged if the inserted marks replace blanks.
pub fn mark(source: &Source) -> Cow<'_, str> {
    let tokens = source.tokens();
    let halves = |token: &Token| -> &[char] {
        match token {
            Token::DivideAssign => &[DIVIDE_HALF, OPERAND_HALF],
            Token::XOrAssign => &[POWER_HALF, OPERAND_HALF],
            Token::PowerOfAssign => &[POWER_HALF, OPERAND_HALF, ' '],
            Token::LeftShiftAssign => &[UP_HALF, OPERAND_HALF, ' '],
            Token::RightShiftAssign => &[DOWN_HALF, OPERAND_HALF, ' '],
            _ => &[],
        }
    };
    let mut marks: Vec<(Position, InsertedMark)> = loop_scoping::bodies(tokens)
        .into_iter()
        .map(|(at, letter)| (at, InsertedMark::Round(letter)))
        .collect();
    marks.extend(switch_rewrite::words(tokens).map(|at| (at, InsertedMark::Choice)));
    let assignments = tokens.iter().map(|(token, at)| (*at, halves(token)));
    marks.extend(
        assignments
            .filter(|(_, halves)| !halves.is_empty())
            .map(|(at, h)| (at, InsertedMark::Assign(h))),
    );
    if marks.is_empty() {
        return Cow::Borrowed(source);
    }
    // Marks are inserted from the end of the text backwards, because they shift the text after them.
    marks.sort_by_key(|(at, _)| std::cmp::Reverse((at.line(), at.position())));
    let mut lines: Vec<Vec<char>> = source.split('\n').map(|line| line.chars().collect()).collect();
    for (at, mark) in marks {
        let (Some(line), Some(column)) = (at.line(), at.position()) else { continue };
        let Some(line) = lines.get_mut(line - 1) else { continue };
        match mark {
            InsertedMark::Round(letter) => loop_scoping::insert_scope(line, column - 1, letter),
            InsertedMark::Choice => switch_rewrite::insert_wrapper(line, column - 1),
            InsertedMark::Assign(halves) => {
                if let Some(target) = line.get_mut(column - 1..column - 1 + halves.len()) {
                    target.copy_from_slice(halves);
                }
            }
        }
    }
    let lines: Vec<String> = lines.into_iter().map(String::from_iter).collect();
    Cow::Owned(lines.join("\n"))
}

enum InsertedMark<'m> {
    Assign(&'m [char]),
    Round(char),
    Choice,
}

#[derive(Clone, Copy, Default)]
struct Chain {
    powers: u8,
    minus: bool,
}

#[derive(Default)]
struct Nesting {
    outer: Vec<Chain>,
    current: Chain,
}

impl Nesting {
    fn map(&mut self, token: Token) -> Token {
        match token {
            Token::XOr | Token::PowerOf => self.power(),
            Token::UnaryMinus => {
                self.current.minus = true;
                token
            }
            Token::IntegerConstant(n) => {
                self.current.minus |= n < 0;
                token
            }
            Token::FloatConstant(ref literal) if is_too_large(&literal.1) => {
                refuse("write it with a decimal point: the whole number is too large for 64 bits")
            }
            Token::FloatConstant(ref literal) => {
                self.current.minus |= literal.0.is_sign_negative();
                token
            }
            Token::LeftParen
            | Token::LeftBracket
            | Token::LeftBrace
            | Token::MapStart
            | Token::QuestionBracket => {
                self.outer.push(std::mem::take(&mut self.current));
                token
            }
            Token::RightParen | Token::RightBracket => {
                self.current = self.outer.pop().unwrap_or_default();
                token
            }
            Token::RightBrace => {
                self.outer.pop();
                self.current = Chain::default();
                token
            }
            Token::Identifier(_)
            | Token::Period
            | Token::DoubleColon
            | Token::Reserved(_)
            | Token::StringConstant(_) => token,
            other => {
                self.current = Chain::default();
                replace(other)
            }
        }
    }

    fn power(&mut self) -> Token {
        let chain = self.current.powers;
        if self.current.minus {
            return refuse("write -(x^2) or (-x)^2: a minus before a power is ambiguous");
        }
        if chain == LONGEST_CHAIN {
            return refuse("too many powers in a row: use parentheses");
        }
        self.current.powers += 1;
        custom(&power_name(chain))
    }
}

/// Returns true for an integer literal that is too large, so that Rhai has converted it to a float.
fn is_too_large(literal: &str) -> bool {
    !literal.contains(['.', 'e', 'E'])
}

fn replace(token: Token) -> Token {
    let symbol = match &token {
        Token::Divide => "/",
        Token::LeftShift => "<<",
        Token::RightShift => ">>",
        Token::LessThan => "<",
        Token::GreaterThan => ">",
        Token::LessThanEqualsTo => "<=",
        Token::GreaterThanEqualsTo => ">=",
        Token::EqualsTo => "==",
        Token::NotEqualsTo => "!=",
        Token::DivideAssign | Token::PowerOfAssign | Token::XOrAssign => {
            return refuse(
                "only x = x / y and x = x ^ y can be written here, not x /= y or x ^= y",
            );
        }
        Token::LexError(error) => return half(error).unwrap_or(token),
        _ => return token,
    };
    custom(&format!("{OWN}{symbol}"))
}

fn half(error: &LexError) -> Option<Token> {
    let LexError::UnexpectedInput(text) = error else { return None };
    match text.chars().next()? {
        DIVIDE_HALF => Some(Token::DivideAssign),
        POWER_HALF => Some(Token::PowerOfAssign),
        UP_HALF => Some(Token::LeftShiftAssign),
        DOWN_HALF => Some(Token::RightShiftAssign),
        OPERAND_HALF => Some(custom(OPERAND)),
        loop_scoping::ONE => Some(custom(loop_scoping::ONE_NAME)),
        loop_scoping::TWO => Some(custom(loop_scoping::TWO_NAME)),
        switch_rewrite::CHOICE => Some(custom(switch_rewrite::CHOICE_NAME)),
        _ => None,
    }
}

fn custom(name: &str) -> Token {
    Token::Custom(Box::new(name.into()))
}

fn refuse(message: &str) -> Token {
    Token::LexError(Box::new(LexError::Runtime(message.into())))
}
