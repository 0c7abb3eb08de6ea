//! Names of Python, MATLAB, JavaScript and C.

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
    entry(&["eps"], "the distance of 1 to the next number is 2.0^-52", &["numbers"]),
    entry(&["1j", "imag", "complex"], "there are no complex numbers", &["numbers"]),
    entry(
        &["Math", "math", "np", "numpy", "scipy", "cmath", "jnp"],
        "sin, sqrt, PI, linspace and the rest stand by themselves: sin(PI / 2); nothing is imported for them",
        &["numbers", "arrays"],
    ),
    entry(
        &[
            "console", "disp", "display", "printf", "fprintf", "println", "puts", "cout", "echo",
            "println!",
        ],
        "write print(`x = ${x}`): values stand in a text between backquotes",
        &["print", "strings"],
    ),
    entry(
        &["sprintf", "num2str", "mat2str", "format", "toFixed", "toPrecision", "toExponential"],
        "`x = ${x}` makes a text of a value; fixed(x, 2) and sci(x, 2) choose the digits",
        &["strings", "fixed", "sci"],
    ),
    entry(
        &["str", "repr", "toString", "char"],
        "write x.to_string(), or `${x}` in a text",
        &["to_string", "strings"],
    ),
    entry(
        &["float", "double", "Number", "parseFloat", "str2num", "str2double"],
        "parse_float(text) makes a number of a text; a whole number needs nothing",
        &["parse_float", "numbers"],
    ),
    entry(
        &["parseInt", "int32", "int64"],
        "write parse_int(text), or int(x) of a number",
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
    entry(&["set", "unique"], "arrays have no repeated elements after dedup()", &["dedup"]),
    entry(&["append", "add", "push_back", "Add"], "write array.push(value)", &["push"]),
    entry(
        &["includes", "has", "hasKey", "has_key", "ismember"],
        "write value in array, or \"key\" in map",
        &["contains"],
    ),
    entry(
        &["size", "numel", "ndims", "shape", "length", "sizeof", "strlen"],
        "the number of elements is array.len, of characters text.len",
        &["len"],
    ),
    entry(
        &["zeros", "ones", "eye", "full", "empty", "repmat", "repeat"],
        "write let a = []; a.pad(3, 0); for three zeros",
        &["pad", "linspace"],
    ),
    entry(
        &["arange", "xrange", "colon"],
        "write 0..10 for whole numbers, linspace(0, 1, 5) for others",
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
        "write array.reduce(|sum, x| sum + x, 0) with what is wanted in it; sum, mean, min and max are there",
        &["reduce", "sum", "mean"],
    ),
    entry(
        &["rand", "random", "randn", "randint", "rng", "seed"],
        "there is no randomness: the same script gives the same numbers",
        &["numbers"],
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
        "a script asks nothing while it runs: put values at its top, let x = 3;",
        &["variables"],
    ),
    entry(
        &["open", "fopen", "csvread", "readtable", "loadtxt", "savetxt", "write", "save_csv"],
        "write_history(sim, \"name\") writes columns to a file, save and load_simulation keep a simulation",
        &["write_history", "save", "load_simulation"],
    ),
    entry(
        &["time", "tic", "toc", "clock", "now", "sleep", "delay", "wait", "pause"],
        "a script does not read the clock: :time INPUT at the prompt measures; the time of a simulation is sim.t",
        &["t"],
    ),
    entry(
        &["exit", "quit", "sys", "bye"],
        "a script ends at its last line, or by return; the prompt is left by :quit or Ctrl-D",
        &["functions"],
    ),
    entry(
        &["clear", "clc", "close", "clearvars", "who", "whos", "hold"],
        "at the prompt :reset forgets all variables, :vars lists them",
        &["variables"],
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
        "there are no classes: a function takes what it works on as an argument",
        &["functions"],
    ),
    entry(
        &["exec", "eval", "evalin"],
        "texts are not run as scripts: write a function",
        &["functions"],
    ),
    entry(&["elif", "elseif"], "write else if … { … }", &["conditions"]),
    entry(&["def", "function", "func"], "a function is written fn f(x) { … }", &["functions"]),
    entry(&["var", "int8", "auto"], "a variable is made by let x = 3;", &["variables"]),
];
