#!/usr/bin/env bash
# Computes the parts of the studies of a script as a Slurm job array, and merges them in a further job.
#
#   scripts/clusters/slurm.sh SCRIPT.rhai PARTS OUT
#
# A part that fails or is killed is requeued, up to three times. Completed work is kept. The variable SBATCH_OPTIONS contains options of sbatch.
set -euo pipefail
script=$1 parts=$2 out=$3
withy=${WITHY:-withy}
array=$(sbatch --parsable ${SBATCH_OPTIONS:-} --array="1-$parts" --job-name=withy-part --output=/dev/null --requeue \
  --export=ALL,WITHY="$withy" <<JOB
#!/usr/bin/env bash
"\$WITHY" study --quiet "$script" --part "\$SLURM_ARRAY_TASK_ID/$parts" --out "$out.parts" && exit
[ "\${SLURM_RESTART_COUNT:-0}" -lt 3 ] && scontrol requeue "\${SLURM_ARRAY_JOB_ID}_\${SLURM_ARRAY_TASK_ID}"
exit 1
JOB
)
sbatch --parsable ${SBATCH_OPTIONS:-} --dependency="afterok:$array" --job-name=withy-merge --output="$out.log" \
  --wrap="'$withy' study --quiet '$script' --merge '$out.parts' --out '$out'"
