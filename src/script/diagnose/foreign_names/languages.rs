//! Names and keywords of other languages, such as Python, MATLAB, JavaScript and C, with their replacements in withy.

use super::entry::{ForeignName, entry};

pub const WORDS: &[ForeignName] = &[
    entry(&["True", "TRUE"], "write true", &["conditions"]),
    entry(&["False", "FALSE"], "write false", &["conditions"]),
    entry(
        &["None", "null", "nil", "undefined", "NULL", "nullptr", "Nothing"],
        "the value nothing is written ()",
        &["variables"],
    ),
    entry(&["Infinity", "infinity"], "write inf", &["inf"]),
    entry(&["eps"], "the distance from 1 to the next number is 2.0^-52", &["numbers"]),
    entry(&["1j", "imag", "complex"], "complex numbers are not available", &["numbers"]),
    entry(
        &["Math", "math", "np", "numpy", "scipy", "cmath", "jnp"],
        "sin, sqrt, PI, linspace and others are available without import: sin(PI / 2)",
        &["numbers", "arrays"],
    ),
    entry(
        &[
            "console", "disp", "display", "printf", "fprintf", "println", "puts", "cout", "echo",
            "println!",
        ],
        "write print(`x = ${x}`): values are inserted in a text between backquotes",
        &["print", "strings"],
    ),
    entry(
        &["sprintf", "num2str", "mat2str", "format", "toFixed", "toPrecision", "toExponential"],
        "`x = ${x}` converts a value to text; fixed(x, 2) and sci(x, 2) set the number of \
        digits",
        &["strings", "fixed", "sci"],
    ),
    entry(
        &["str", "string", "repr", "toString", "char"],
        "write x.to_string(), or `${x}` in a text",
        &["to_string", "strings"],
    ),
    entry(
        &["float", "double", "Number", "parseFloat", "str2num", "str2double"],
        "parse_float(text) converts a text to a number; whole numbers need no conversion",
        &["parse_float", "numbers"],
    ),
    entry(
        &["parseInt", "int32", "int64"],
        "write parse_int(text), or int(x) for a number",
        &["parse_int", "int"],
    ),
    entry(
        &["list", "tuple", "Array", "vector", "cell", "arr"],
        "an array is written [1, 2, 3]",
        &["arrays"],
    ),
    entry(
        &["dict", "Object", "struct", "Map", "containers", "table2struct"],
        "a map is written #{ key: value }",
        &["maps", "options"],
    ),
    entry(&["set", "unique"], "array.dedup() removes repeated elements", &["dedup"]),
    entry(&["append", "add", "push_back", "Add"], "write array.push(value)", &["push"]),
    entry(
        &["includes", "has", "hasKey", "has_key", "ismember"],
        "write value in array, or \"key\" in map",
        &["contains"],
    ),
    entry(
        &["size", "numel", "ndims", "shape", "length", "sizeof", "strlen"],
        "array.len is the number of elements, text.len the number of characters",
        &["len"],
    ),
    entry(
        &["zeros", "ones", "eye", "full", "empty", "repmat", "repeat"],
        "write let a = []; a.pad(3, 0); for an array of three zeros",
        &["pad", "linspace"],
    ),
    entry(
        &["arange", "xrange", "colon"],
        "write 0..10 for whole numbers, linspace(0, 1, 5) for other numbers",
        &["range", "linspace"],
    ),
    entry(&["enumerate"], "write for (x, i) in array { … }", &["loops"]),
    entry(&["zip"], "write for (x, i) in array { … other[i] … }", &["loops"]),
    entry(
        &["slice", "splice", "substr", "substring"],
        "write array.extract(1..3), or text.sub_string(1, 2)",
        &["extract", "sub_string"],
    ),
    entry(
        &["join", "strjoin", "strcat", "concat"],
        "+ joins texts and arrays; array.reduce(|a, b| a + b) joins many",
        &["operators", "reduce"],
    ),
    entry(&["items", "entries"], "write for key in map.keys() { … map[key] … }", &["keys"]),
    entry(&["strip", "chomp"], "write text.trim()", &["trim"]),
    entry(&["upper", "toUpperCase"], "write text.to_upper()", &["to_upper"]),
    entry(&["lower", "toLowerCase"], "write text.to_lower()", &["to_lower"]),
    entry(&["mod", "rem", "fmod"], "write a % b, the remainder", &["operators"]),
    entry(&["ceil"], "write ceiling(x)", &["ceiling"]),
    entry(&["trunc"], "write int(x)", &["int"]),
    entry(&["pow", "power", "square", "mpower"], "write x^2, or x ** 2", &["operators"]),
    entry(&["cbrt"], "write x^(1/3)", &["operators"]),
    entry(&["fabs"], "write abs(x)", &["abs"]),
    entry(&["arcsin"], "write asin(x)", &["asin"]),
    entry(&["arccos"], "write acos(x)", &["acos"]),
    entry(&["arctan"], "write atan(x)", &["atan"]),
    entry(&["arctan2"], "write atan2(y, x)", &["atan2"]),
    entry(
        &["prod", "cumsum", "diff", "median"],
        "write array.reduce(|sum, x| sum + x, 0) with the required operation; sum, mean, min \
        and max are available",
        &["reduce", "sum", "mean"],
    ),
    entry(
        &["rand", "random", "randn", "randint", "rng", "seed"],
        "a script always has the same results: sobol(count, seed) and latin_hypercube(count, seed) \
        are reproducible samples; there is no other random number",
        &["sobol", "latin_hypercube", "study_sweep"],
    ),
    entry(
        &["fft", "fourier", "psd", "power spectrum"],
        "sim.history.spectrum(column) computes the amplitude spectrum of a column",
        &["spectrum"],
    ),
    entry(
        &[
            "optimise",
            "optimize",
            "optimisation",
            "optimization",
            "minimize",
            "fmincon",
            "fminsearch",
        ],
        "minimise(#{ … }) finds the best parameters of a function with constraints, fit(#{ … }) \
        those that match measured values",
        &["minimise", "fit", "find_root"],
    ),
    entry(&["typeof", "isinstance", "class", "getClass"], "write type_of(x)", &["type_of"]),
    entry(
        &["assert", "require", "expect", "ASSERT"],
        "write check(condition, \"what it means\")",
        &["check"],
    ),
    entry(
        &["raise", "error", "Error", "Exception", "ValueError", "TypeError"],
        "write throw \"what is wrong\";",
        &["try"],
    ),
    entry(
        &["input", "raw_input", "readline", "scanf", "gets"],
        "a script has no input while it runs: define values at its top, let x = 3;",
        &["variables"],
    ),
    entry(
        &["open", "fopen", "csvread", "readtable", "loadtxt", "savetxt", "write", "save_csv"],
        "write_history(sim, \"name\") writes columns to a file, save and load_simulation store \
        a simulation",
        &["write_history", "save", "load_simulation"],
    ),
    entry(
        &["time", "tic", "toc", "clock", "now", "sleep", "delay", "wait", "pause"],
        "scripts have no clock: :time INPUT at the prompt measures durations; the time of a \
        simulation is sim.t",
        &["t"],
    ),
    entry(
        &["exit", "quit", "sys", "bye"],
        "a script ends at its last line, or by return; leave the prompt by :quit or Ctrl-D",
        &["functions"],
    ),
    entry(
        &["clear", "clc", "close", "clearvars", "who", "whos"],
        "at the prompt :reset deletes all variables, :vars lists them",
        &["variables"],
    ),
    entry(
        &["hold"],
        "hold_for(2.5) is a schedule that is 1 until t = 2.5 and 0 later; plots draw several \
        curves in one call",
        &["hold_for", "plot"],
    ),
    entry(
        &["back_to", "go_back", "seek", "set_time"],
        "sim.rewind(t) goes back to an earlier time, sim.back(n) goes back n steps",
        &["rewind", "back"],
    ),
    entry(&["pass"], "an empty block is written { }", &["conditions"]),
    entry(
        &["end"],
        "a block ends with }; the last element of an array is array[-1]",
        &["conditions", "arrays"],
    ),
    entry(&["lambda"], "a function without a name is written |x| …", &["closures"]),
    entry(
        &["feval", "apply", "invoke"],
        "a function in a variable is called by f.call(x)",
        &["call"],
    ),
    entry(
        &["self", "cls", "super"],
        "classes are not available: pass the data of a function as arguments",
        &["functions"],
    ),
    entry(
        &["exec", "eval", "evalin"],
        "texts cannot be executed: write a function",
        &["functions"],
    ),
    entry(&["elif", "elseif"], "write else if … { … }", &["conditions"]),
    entry(&["def", "function", "func"], "a function is written fn f(x) { … }", &["functions"]),
    entry(&["var", "int8", "auto"], "declare a variable by let x = 3;", &["variables"]),
];
