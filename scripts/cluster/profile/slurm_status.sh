#!/usr/bin/env bash
# Tells Snakemake how a Slurm job stands: running, success or failed. Without accounting only scontrol knows,
# and it forgets a job some minutes after its end; a forgotten job is judged by its outputs, so: success.
state=$(scontrol -o show job "$1" 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p')
case "$state" in
    COMPLETED|"") echo success ;;
    PENDING|CONFIGURING|RUNNING|COMPLETING|SUSPENDED|REQUEUED) echo running ;;
    *) echo failed ;;
esac
