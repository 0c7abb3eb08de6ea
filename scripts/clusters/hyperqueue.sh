#!/usr/bin/env bash
# Parts of the studies of a script as a task array of HyperQueue, and then joined. A server and workers must run: hq server start, hq worker start.
#
#   scripts/clusters/hyperqueue.sh SCRIPT.rhai PARTS OUT
#
# A task whose worker is lost is given to another one by HyperQueue, and a part whose process is killed is begun again: both go on where they were.
set -euo pipefail
script=$1 parts=$2 out=$3
withy=${WITHY:-withy}
hq submit --wait --array "1-$parts" --crash-limit 3 --stdout none -- \
  bash -c "for try in 1 2 3; do '$withy' study --quiet '$script' --part \"\$HQ_TASK_ID/$parts\" --out '$out.parts' && exit 0; done; exit 1"
"$withy" study --quiet "$script" --merge "$out.parts" --out "$out"
