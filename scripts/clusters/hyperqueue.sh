#!/usr/bin/env bash
# Computes the parts of the studies of a script as a task array of HyperQueue, and merges them. A server and workers must run: hq server start, hq worker start.
#
#   scripts/clusters/hyperqueue.sh SCRIPT.rhai PARTS OUT
#
# If a worker is lost, HyperQueue assigns its task to another worker. A part whose process is killed is started again. In both cases, completed work is kept.
set -euo pipefail
script=$1 parts=$2 out=$3
withy=${WITHY:-withy}
hq submit --wait --array "1-$parts" --crash-limit 3 --stdout none -- \
  bash -c "for try in 1 2 3; do '$withy' study --quiet '$script' --part \"\$HQ_TASK_ID/$parts\" --out '$out.parts' && exit 0; done; exit 1"
"$withy" study --quiet "$script" --merge "$out.parts" --out "$out"
