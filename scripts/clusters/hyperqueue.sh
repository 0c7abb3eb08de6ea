#!/usr/bin/env bash
# Parts of the studies of a script as a task array of HyperQueue, and then joined. A server and workers must run: hq server start, hq worker start.
#
#   scripts/clusters/hyperqueue.sh SCRIPT.rhai PARTS OUT
#
# A task whose worker is lost is given to another one by HyperQueue: it goes on where it was.
set -euo pipefail
script=$1 parts=$2 out=$3
withy=${WITHY:-withy}
hq submit --wait --array "1-$parts" --crash-limit 3 --stdout none -- \
  bash -c "'$withy' study --quiet '$script' --part \"\$HQ_TASK_ID/$parts\" --out '$out.parts'"
"$withy" study --quiet "$script" --merge "$out.parts" --out "$out"
