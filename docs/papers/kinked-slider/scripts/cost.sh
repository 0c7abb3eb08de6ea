#!/bin/sh
# Instructions of a step and Newton iterations, counted by valgrind as the difference of runs of 20 and 40 steps (table 10).
# sh scripts/cost.sh > data/cost.csv
withy=${WITHY:-withy}
script=$(dirname "$0")/cost.rhai
count() {
    valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file=/dev/null "$withy" run --error=never -q --set rule="$1" --set spans="$2" --set steps="$3" "$script" 2>&1 |
        awk '/I *refs/ { gsub(",", "", $NF); refs = $NF } /^(none|conserving|kinked|exact|relaxed) / { unknowns = $4; iterations = $5 } END { print unknowns, iterations, refs }'
}
echo rule,spans,unknowns,iterations,instructions
for spans in 8 16 64; do
    for rule in none conserving exact kinked; do
        set -- "$rule" "$spans" $(count "$rule" "$spans" 20) $(count "$rule" "$spans" 40)
        echo "$1,$2,$3,$(echo "scale=2; ($7 - $4) / 20" | bc),$(( ($8 - $5) / 20 ))"
    done
done
