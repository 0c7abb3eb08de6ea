#!/usr/bin/env bash
# Computes the parts of the studies of a script by GNU parallel, on this or on other machines, and merges them.
#
#   scripts/clusters/parallel.sh SCRIPT.rhai PARTS OUT [options of parallel, such as --jobs 4 or --sshlogin HOSTS --workdir .]
#
# A part that fails or is killed is started again, up to three times in total. Completed work is kept. All machines must share the folder.
set -euo pipefail
script=$1 parts=$2 out=$3
shift 3
withy=${WITHY:-withy}
seq "$parts" | parallel --retries 3 "$@" "$withy" study --quiet "$script" --part "{}/$parts" --out "$out.parts"
"$withy" study --quiet "$script" --merge "$out.parts" --out "$out"
