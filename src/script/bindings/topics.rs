//! Help topics on the language itself, each with a runnable example.

pub struct Topic {
    pub name: &'static str,
    pub words: &'static [&'static str],
    pub summary: &'static str,
    pub doc: &'static str,
    pub example: &'static str,
    pub see: &'static [&'static str],
}

/// All topics, in the order in which they should be read.
pub const TOPICS: &[Topic] = &[
    Topic {
        name: "numbers",
        words: &["number", "whole number", "arithmetic", "units"],
        summary: "Numbers follow the rules of science.",
        doc: "Division is never truncated: `1/20` is 0.05; `quotient(n, d)` divides whole \
            numbers. `^` and `**` are powers, evaluated from right to left. Comparisons follow \
            IEEE 754. A whole number is accepted wherever a number is. A minus before a power \
            must be written `-(x^2)` or `(-x)^2`. `switch` distinguishes 3 from 3.0. Whole \
            numbers have 64 bits, and an overflow is an error, in powers too: 10^20 is \
            refused, 10.0^20 is the nearest number. Use any consistent set of units: help \
            names dimensions, such as [force], and no units.",
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
        summary: "Operators between two values, in the order of their precedence.",
        doc: "Highest precedence first: powers `^` and `**`; then `*`, `/` and `%` (remainder); \
            then `+` and `-`; then the comparisons `<`, `>`, `<=` and `>=`; then `==` and \
            `!=`; then `&&` (and), whose second operand is not evaluated if the first is \
            false; then `||` (or). `!` means not. `x += 1` stands for `x = x + 1`, and so on \
            for `-=`, `*=`, `/=`, `^=`, `**=`, `<<=` and `>>=`. `+` also joins texts, arrays \
            and maps. `a in b` is true if b contains a, `a !in b` if it does not. `a ?? b` is \
            b if a is nothing; `a?.b` is nothing if a is nothing. `<<`, `>>`, `&` and `|` work \
            on the bits of whole numbers; the loss of a bit is an error.",
        example: "check(2 + 3 * 2^2 == 14 && 7 % 4 == 3);\nlet x = 1;\nx += 2;\ncheck(x == 3 && !(x > 3 || x == 0));\n\
                  check(\"beam\" + 1 == \"beam1\" && [1] + [2] == [1, 2]);\ncheck(2 in [1, 2] && \"dt\" !in #{ t: 0 });\ncheck((() ?? 5) == 5);",
        see: &["numbers", "contains"],
    },
    Topic {
        name: "variables",
        words: &["let", "const", "variable", "nothing", "()"],
        summary: "`let` declares a variable, `const` a constant.",
        doc: "A variable exists until the end of the block `{ … }` in which it is declared, and \
            may be declared again with the same name. Numbers, texts, arrays and maps are \
            copied when they are assigned; scenes, beams and simulations are handles: both \
            names refer to the same object. The value nothing is written `()`. A block is an \
            expression with the value of its last expression, if no semicolon follows.",
        example: "let length = 2;\nlength = 3;\nconst E_STEEL = 2.1e11;\nlet a = [1, 2];\nlet b = a;\nb.push(3);\n\
                  check(a.len == 2 && b.len == 3);\nlet area = { let side = 0.1; side^2 };\ncheck_close(area, 0.01, 1e-15);",
        see: &["functions", "type_of"],
    },
    Topic {
        name: "strings",
        words: &["string", "text", "interpolation", "`", "\"", "character"],
        summary: "Texts and values within texts.",
        doc: "A text is written in double quotes, with `\\n` for a new line and `\\\"` for a \
            quote. Between backquotes a text may have several lines, and `${ … }` contains an \
            expression whose value is inserted. `'a'` is a character. Numbers print with as \
            many digits as needed, negative zero as 0; fixed and sci set the number of digits. \
            Control characters and invisible marks print as \u{fffd}.",
        example: "let x = 1/3;\nprint(`a third is ${fixed(x, 3)}, twice that ${2 * x}`);\ncheck(`${1 + 1} beams` == \"2 beams\");\n\
                  check(\"spa\" + \"ghetti\" == \"spaghetti\");",
        see: &["fixed", "sci", "tabulate", "texts"],
    },
    Topic {
        name: "points",
        words: &["point", "[x, y]"],
        summary: "A point or vector of the plane is an array `[x, y]` or a vector.",
        doc: "Every function with a point as argument accepts both. `vec(x, y)`, `polar` and \
            functions that return points create vectors; they can be added, subtracted and \
            multiplied by numbers, and have components x and y. `+` of two arrays joins them: \
            [1, 2] + [1, 0] has four elements; 2 * [1, 2] is refused with an error. In a sum \
            of points at least one must therefore be a vector. An array of points is an array \
            of such pairs.",
        example: "check(distance([0, 0], [3, 4]) == 5);\nlet p = vec(1, 2) + [1, 0];\ncheck(p == [2, 2] && p.x == 2);\ncheck(2 * p == vec(4, 4));\ncheck([1, 2] + [1, 0] == [1, 2, 1, 0]);",
        see: &["vec", "polar", "vectors"],
    },
    Topic {
        name: "options",
        words: &["option", "#{"],
        summary: "Options are given by name in a map: `#{ key: value }`.",
        doc: "Help lists the keys of a function with allowed values, unit and default. A \
            misspelt key is an error that lists the known keys. Options can be stored in a \
            variable and used again, and `+` joins two maps; values of the second one replace \
            those of the first.",
        example: "let common = #{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 };\nlet soft = section(common + #{ EI: 10 });\ncheck(soft.EI == 10);",
        see: &["section", "maps"],
    },
    Topic {
        name: "conditions",
        words: &["if", "else", "switch", "true", "false", "condition"],
        summary: "`if` and `switch` select a branch; both are expressions with a value.",
        doc: "A condition is true or false, never a number. Braces are required. `switch` \
            compares with the cases in turn; `_` is every other value. A case may be a range \
            of whole numbers.",
        example: "let n = 7;\nlet size = if n < 5 { \"small\" } else { \"large\" };\ncheck(size == \"large\");\n\
                  let what = switch n { 0 => \"none\", 1..10 => \"a few\", _ => \"many\" };\ncheck(what == \"a few\");",
        see: &["loops", "operators"],
    },
    Topic {
        name: "loops",
        words: &["for", "while", "loop", "do", "until", "break", "continue", "loop over"],
        summary: "`for` loops over an array, a range or a text; `while` and `loop` repeat until \
            their condition or a `break` ends them.",
        doc: "`for (x, i) in array` also counts the index. `break` ends a loop, `continue` \
            starts its next round. Ctrl-C interrupts a loop.",
        example: "let total = 0;\nfor i in 0..4 { total += i; }\ncheck(total == 6);\nfor (name, i) in [\"a\", \"b\"] { print(`${i}: ${name}`); }\n\
                  let n = 1;\nwhile n < 100 { n *= 2; }\ncheck(n == 128);\nloop { n -= 1; if n == 100 { break; } }\ncheck(n == 100);",
        see: &["range", "linspace", "map", "conditions"],
    },
    Topic {
        name: "functions",
        words: &["fn", "return", "private", "this", "function"],
        summary: "`fn name(a, b) { … }` defines a function.",
        doc: "The result is the value of the last expression, or of `return`. The function can \
            use its arguments, other functions and the built-in constants, but no variables \
            from outside: pass them as arguments, or use a closure. An argument with the name \
            of a constant hides it: in |E| 2 * E it is the argument. Arguments are copies, \
            except handles. `a.f(b)` calls `f(a, b)` for functions of the language, and a \
            function of the script with `this` = a.",
        example: "fn area(radius) { PI * radius^2 }\ncheck(area(1) == PI);\nfn sign_of(x) {\n    if x < 0 { return -1; }\n    1\n}\ncheck(sign_of(-3) == -1);",
        see: &["closures", "import"],
    },
    Topic {
        name: "closures",
        words: &["closure", "callback"],
        summary: "`|x| …` is a function that can use the variables around it.",
        doc: "A closure can be passed to functions such as loads and `map`, or stored in a \
            variable and called with `call`. Variables that it uses are shared: a change \
            inside is visible outside, and the reverse. Every round of a for loop has its own \
            variable.",
        example: "let k = 3;\nlet line = |x| k * x;\ncheck(line.call(2) == 6);\ncheck([1, 2].map(|x| k * x) == [3, 6]);\n\
                  let count = 0;\nlet tick = || count += 1;\ntick.call();\ncheck(count == 1);",
        see: &["call", "curry", "functions"],
    },
    Topic {
        name: "try",
        words: &["catch", "throw", "error handling", "errors"],
        summary: "`try { … } catch (problem) { … }` continues after an error; `throw` raises an \
            error.",
        doc: "An error of a function of withy is caught with a message and a hint; a value \
            thrown by the script is caught unchanged. An interrupt cannot be caught. A failed \
            check is not an error: the script continues.",
        example: "try { sqrt(\"two\") } catch (problem) { print(problem.message); }\n\
                  let caught = \"\";\ntry { throw \"too long\"; } catch (problem) { caught = problem; }\ncheck(caught == \"too long\");",
        see: &["check", "message", "hint"],
    },
    Topic {
        name: "import",
        words: &["export", "as", "module", "modules", "library", "std"],
        summary: "`import \"name\" as n;` reads `name.rhai` beside the script, `import \"std/name\" \
            as n;` a module of the library.",
        doc: "Functions of the module are called `n::function(…)`; variables exported with \
            `export` are `n::variable`. A file is read once; a file that imports itself is an \
            error. Closures of another file cannot be called. Names that begin with std/ \
            belong to the library: files in a folder std of your own are not read.",
        example: "fn twice(x) { 2 * x }\nexport const LENGTH = 2;\n\
                  // If this were parts.rhai, another file beside it could say\n\
                  // import \"parts\" as parts; print(parts::twice(parts::LENGTH));\ncheck(twice(LENGTH) == 4);\n\
                  import \"std/checks\" as checks;\nchecks::assert_close(\"twice\", twice(LENGTH), 4, 0);",
        see: &["functions"],
    },
    Topic {
        name: "comments",
        words: &["comment", "//", "/*"],
        summary: "`//` begins a comment up to the end of the line; `/* … */` may have several lines.",
        doc: "`///` before a function documents it, `//!` at the top documents the script.",
        example: "let dt = 0.1; // time\n/* a comment\n   of two lines */\ncheck(dt == 0.1);",
        see: &[],
    },
    Topic {
        name: "reserved words",
        words: &["reserved", "keywords", "words", "keyword"],
        summary: "Words that cannot be names of variables or functions.",
        doc: "In use: true, false, let, const, if, else, switch, do, while, until, loop, for, \
            in, continue, break, return, throw, try, catch, fn, private, import, export, as, \
            this, Fn, call, curry, is_def_fn, is_def_var, is_shared, type_of, print, debug. \
            Kept for later: var, static, goto, match, case, new, use, with, is, module, \
            package, super, public, protected, thread, spawn, go, await, async, sync, yield, \
            default, void, null, nil. eval does not exist. As keys of a map such words are \
            written in quotes: `#{ \"case\": 1 }`.",
        example: "let m = #{ \"case\": 1 };\ncheck(m[\"case\"] == 1);",
        see: &["variables"],
    },
];
