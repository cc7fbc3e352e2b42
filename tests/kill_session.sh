# shellcheck shell=bash
# Sourced by scripts that kill a run with all its ranks, and nothing else: start it as `setsid COMMAND... &`, then `kill_session $!`.
# A launcher gives each rank a process group of its own, but all stay in its session.

# Kills all of the session $1, the youngest first: a launcher would end its ranks in order.
kill_session() {
  local alive
  while alive=$(ps -o pid=,stat= --sort=-start_time,-pid -s "$1" | awk '$2 !~ /^Z/ { print $1 }') && [ -n "$alive" ]; do
    # shellcheck disable=SC2086
    kill -KILL $alive 2>/dev/null || true
  done
}
