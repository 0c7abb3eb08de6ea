#!/usr/bin/env bash
# Parts of the studies of a script by GNU parallel, here or on other machines, and then joined.
#
#   scripts/clusters/parallel.sh SCRIPT.rhai PARTS OUT [options of parallel, such as --jobs 4 or --sshlogin HOSTS --workdir .]
#
# A part that fails or is killed is tried again, three times in all: it goes on where it was. Other machines see the same folder.
set -euo pipefail
script=$1 parts=$2 out=$3
shift 3
withy=${WITHY:-withy}
seq "$parts" | parallel --retries 3 "$@" "$withy" study --quiet "$script" --part "{}/$parts" --out "$out.parts"
"$withy" study --quiet "$script" --merge "$out.parts" --out "$out"
