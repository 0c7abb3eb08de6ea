//! Short pages on the language itself, each with an example that runs.

/// A topic of the help: a page on a part of the language.
pub struct Topic {
    /// The name of the topic, a heading in the reference.
    pub name: &'static str,
    /// The words of the language that the topic explains, and other names for it.
    pub words: &'static [&'static str],
    /// One line on the topic.
    pub summary: &'static str,
    /// A few sentences on the topic.
    pub doc: &'static str,
    /// A script that runs and shows what the topic is about.
    pub example: &'static str,
    /// Names that are related to the topic.
    pub see: &'static [&'static str],
}

/// All topics of the help, in the order in which to read them.
pub const TOPICS: &[Topic] = &[
    Topic {
        name: "numbers",
        words: &["number", "whole number", "arithmetic", "units"],
        summary: "Numbers behave as in science.",
        doc: "Division is never truncated: `1/20` is 0.05; `quotient(n, d)` divides whole numbers. `^` and `**` are powers, from right to \
              left. Comparisons are those of IEEE 754. A whole number is welcome wherever a number is. A minus before a power \
              must be written `-(x^2)` or `(-x)^2`. `switch` tells 3 from 3.0. Whole numbers have 64 bits, and to leave that range is \
              an error, in powers too: 10^20 is refused, 10.0^20 is the nearest number. Any consistent set of units will do: help names dimensions, such as [force], and no units.",
        example: "check(1/20 == 0.05 && 7/2 == 3.5);\ncheck(2^3^2 == 512 && 2^-1 == 0.5);\ncheck(1/0 == inf && nan != nan);\n\
                  let half = 5e-1;\ncheck(half == 0.5 && 1_000_000 == 1e6);",
        see: &["operators", "quotient", "fixed", "sci"],
    },
    Topic {
        name: "operators",
        words: &[
            "+",
            "-",
            "*",
            "/",
            "%",
            "^",
            "**",
            "==",
            "!=",
            "<",
            ">",
            "<=",
            ">=",
            "&&",
            "||",
            "!",
            "??",
            "?.",
            "in",
            "&",
            "|",
            "<<",
            ">>",
            "+=",
            "-=",
            "*=",
            "/=",
            "^=",
            "**=",
            "<<=",
            ">>=",
            "=",
            "precedence",
            "operator",
        ],
        summary: "What stands between two values, from what binds tightest to what binds loosest.",
        doc: "Powers `^` and `**`; then `*`, `/` and `%` (remainder); then `+` and `-`; then the comparisons `<`, `>`, `<=` and `>=`; then `==` and `!=`; then `&&` (and), whose second half is not asked when the first is false; then `||` (or). `!` means not. `x += 1` stands for `x = x + 1`, and so on for `-=`, `*=`, `/=`, `^=`, `**=`, `<<=` and `>>=`. `+` joins texts, arrays and maps as well. `a in b` asks whether b contains a, `a !in b` the contrary. `a ?? b` is b when a is nothing; `a?.b` is nothing when a is. `<<`, `>>`, `&` and `|` work on the bits of whole numbers; a bit that would be lost is an error.",
        example: "check(2 + 3 * 2^2 == 14 && 7 % 4 == 3);\nlet x = 1;\nx += 2;\ncheck(x == 3 && !(x > 3 || x == 0));\n\
                  check(\"beam\" + 1 == \"beam1\" && [1] + [2] == [1, 2]);\ncheck(2 in [1, 2] && \"dt\" !in #{ t: 0 });\ncheck((() ?? 5) == 5);",
        see: &["numbers", "contains"],
    },
    Topic {
        name: "variables",
        words: &["let", "const", "variable", "nothing", "()"],
        summary: "`let` makes a variable, `const` a name whose value stays.",
        doc: "A variable lives until the end of the block `{ … }` it is made in, and may be made again under the same name. \
              Numbers, texts, arrays and maps are copied when they are assigned; scenes, beams and simulations are handles: both \
              names mean the same thing. The value nothing is written `()`. A block is a value too: that of its last \
              expression, when no semicolon follows.",
        example: "let length = 2;\nlength = 3;\nconst E_STEEL = 2.1e11;\nlet a = [1, 2];\nlet b = a;\nb.push(3);\n\
                  check(a.len == 2 && b.len == 3);\nlet area = { let side = 0.1; side^2 };\ncheck_close(area, 0.01, 1e-15);",
        see: &["functions", "type_of"],
    },
    Topic {
        name: "strings",
        words: &["string", "text", "interpolation", "`", "\"", "character"],
        summary: "Texts, and values within texts.",
        doc: "A text stands in double quotes, with `\\n` for a new line and `\\\"` for a quote. Between backquotes a text may have several lines, and `${ … }` holds any expression, which is printed in its place. `'a'` is a character. Numbers print \
              with as many digits as they need, a negative zero as 0; fixed and sci choose the digits. Control characters and marks that would lead a terminal astray print as \u{fffd}.",
        example: "let x = 1/3;\nprint(`a third is ${fixed(x, 3)}, twice that ${2 * x}`);\ncheck(`${1 + 1} beams` == \"2 beams\");\n\
                  check(\"spa\" + \"ghetti\" == \"spaghetti\");",
        see: &["fixed", "sci", "tabulate", "texts"],
    },
    Topic {
        name: "points",
        words: &["point", "[x, y]"],
        summary: "A point or vector of the plane is an array `[x, y]` or a vector.",
        doc: "Every function that takes a point takes both. Vectors come from `vec(x, y)`, `polar` and functions that give points; \
              they add, subtract and scale, and have components x and y. An array is a list of anything, of which + makes a longer \
              one: [1, 2] + [1, 0] has four elements, as texts and maps are joined, and 2 * [1, 2] is refused. So one of the two in \
              a sum of points has to be a vector. An array of points is an array of such pairs.",
        example: "check(distance([0, 0], [3, 4]) == 5);\nlet p = vec(1, 2) + [1, 0];\ncheck(p == [2, 2] && p.x == 2);\ncheck(2 * p == vec(4, 4));\ncheck([1, 2] + [1, 0] == [1, 2, 1, 0]);",
        see: &["vec", "polar", "vectors"],
    },
    Topic {
        name: "options",
        words: &["option", "#{"],
        summary: "Options are given by name in a map: `#{ key: value }`.",
        doc: "Help lists the keys of a function with what is allowed, the unit, and what holds when the key is left out. A \
              misspelt key is an error that names the known ones. Options kept in a variable can be used again, and `+` joins \
              two maps, where the second wins.",
        example: "let common = #{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 };\nlet soft = section(common + #{ EI: 10 });\ncheck(soft.EI == 10);",
        see: &["section", "maps"],
    },
    Topic {
        name: "conditions",
        words: &["if", "else", "switch", "true", "false", "condition"],
        summary: "`if` and `switch` choose; both give a value.",
        doc: "A condition is true or false, never a number. Braces are always written. `switch` compares with the cases in turn; `_` is every other value. A case may be a range of whole numbers.",
        example: "let n = 7;\nlet size = if n < 5 { \"small\" } else { \"large\" };\ncheck(size == \"large\");\n\
                  let what = switch n { 0 => \"none\", 1..10 => \"a few\", _ => \"many\" };\ncheck(what == \"a few\");",
        see: &["loops", "operators"],
    },
    Topic {
        name: "loops",
        words: &["for", "while", "loop", "do", "until", "break", "continue", "loop over"],
        summary: "`for` goes over an array, a range or a text; `while` and `loop` go on as long as they should.",
        doc: "`for (x, i) in array` counts along. `break` leaves a loop, `continue` goes to its next round. A loop is left by Ctrl-C \
              as well.",
        example: "let total = 0;\nfor i in 0..4 { total += i; }\ncheck(total == 6);\nfor (name, i) in [\"a\", \"b\"] { print(`${i}: ${name}`); }\n\
                  let n = 1;\nwhile n < 100 { n *= 2; }\ncheck(n == 128);\nloop { n -= 1; if n == 100 { break; } }\ncheck(n == 100);",
        see: &["range", "linspace", "map", "conditions"],
    },
    Topic {
        name: "functions",
        words: &["fn", "return", "private", "this", "function"],
        summary: "`fn name(a, b) { … }` defines a function.",
        doc: "It gives the value of its last expression, or of `return`. It sees its arguments, other functions and the built-in \
              constants, but no variables from outside: pass them, or use a closure. A name of its own hides a constant: in |E| 2 * E \
              it is the argument. Arguments are copies, but of handles. \
              `a.f(b)` calls `f(a, b)` for functions of the language, and a function of the script with `this` = a.",
        example: "fn area(radius) { PI * radius^2 }\ncheck(area(1) == PI);\nfn sign_of(x) {\n    if x < 0 { return -1; }\n    1\n}\ncheck(sign_of(-3) == -1);",
        see: &["closures", "import"],
    },
    Topic {
        name: "closures",
        words: &["closure", "callback"],
        summary: "`|x| …` is a function that sees the variables around it.",
        doc: "It can be given to functions that take one, such as loads and `map`, or kept in a variable and called with `call`. \
              Variables that it uses are shared with it: a change on one side is seen on the other. Every round of a \
              for loop has a variable of its own.",
        example: "let k = 3;\nlet line = |x| k * x;\ncheck(line.call(2) == 6);\ncheck([1, 2].map(|x| k * x) == [3, 6]);\n\
                  let count = 0;\nlet tick = || count += 1;\ntick.call();\ncheck(count == 1);",
        see: &["call", "curry", "functions"],
    },
    Topic {
        name: "try",
        words: &["catch", "throw", "error handling", "errors"],
        summary: "`try { … } catch (problem) { … }` goes on after an error; `throw` raises one.",
        doc: "What is caught from a function of withy has a message and a hint; what the script throws is caught as it was thrown. \
              An interrupt is never caught. A check that fails is no error: the script goes on.",
        example: "try { sqrt(\"two\") } catch (problem) { print(problem.message); }\n\
                  let caught = \"\";\ntry { throw \"too long\"; } catch (problem) { caught = problem; }\ncheck(caught == \"too long\");",
        see: &["check", "message", "hint"],
    },
    Topic {
        name: "import",
        words: &["export", "as", "module", "modules", "library", "std"],
        summary: "`import \"name\" as n;` reads `name.rhai` beside the script, `import \"std/name\" as n;` a module of the library.",
        doc: "Its functions are called `n::function(…)`, its variables that are exported with `export` are `n::variable`. A file is read \
              once; one that imports itself is an error. Closures that come from another file cannot be called. Names that begin with std/ belong to the library: \
              a file of your own in a folder std is not read.",
        example: "fn twice(x) { 2 * x }\nexport const LENGTH = 2;\n\
                  // If this were parts.rhai, another file beside it could say\n\
                  // import \"parts\" as parts; print(parts::twice(parts::LENGTH));\ncheck(twice(LENGTH) == 4);\n\
                  import \"std/checks\" as checks;\nchecks::assert_close(\"twice\", twice(LENGTH), 4, 0);",
        see: &["functions"],
    },
    Topic {
        name: "comments",
        words: &["comment", "//", "/*"],
        summary: "`//` begins a comment that ends with the line; `/* … */` may have several lines.",
        doc: "`///` before a function documents it, `//!` at the top documents the script.",
        example: "let dt = 0.1; // time\n/* a comment\n   of two lines */\ncheck(dt == 0.1);",
        see: &[],
    },
    Topic {
        name: "reserved words",
        words: &["reserved", "keywords", "words", "keyword"],
        summary: "Words that cannot be names of variables or functions.",
        doc: "In use: true, false, let, const, if, else, switch, do, while, until, loop, for, in, continue, break, return, throw, try, \
              catch, fn, private, import, export, as, this, Fn, call, curry, is_def_fn, is_def_var, is_shared, type_of, print, \
              debug. Kept for later: var, static, goto, match, case, new, use, with, is, module, package, super, public, \
              protected, thread, spawn, go, await, async, sync, yield, default, void, null, nil. eval is not there. As keys of a map \
              such words stand in quotes: `#{ \"case\": 1 }`.",
        example: "let m = #{ \"case\": 1 };\ncheck(m[\"case\"] == 1);",
        see: &["variables"],
    },
];
