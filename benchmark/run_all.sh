#!/usr/bin/env bash
# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Reproduces all measurements: builds the benchmarks, makes the charts of real meshes in CHARTS_DIR
# unless they are there, and puts the results into OUT. Interrupted, it goes on where it stopped
# when it is called again. Nothing else should run on the machine meanwhile.
#
# Usage: benchmark/run_all.sh CHARTS_DIR OUT
#
# Environment:
#   REPEAT          runs of each method, whose median counts (3)
#   LIMIT           seconds for a run (600)
#   MAX_FACES       of the charts (7000000; the largest of all needs 11000000)
#   HLSCM_DATA_DIR  the meshes of Debian's libcgal-demo (unpacked into CHARTS_DIR/meshes)
#   HLSCM_BIN       folder of the built programs (what is missing is installed, and they are built)

source "$(dirname "${BASH_SOURCE[0]}")/../scripts/common.sh"

[ "$#" -eq 2 ] || fail "usage: benchmark/run_all.sh CHARTS_DIR OUT"
mkdir -p "$1" "$2"
charts="$(cd "$1" && pwd)"
out="$(cd "$2" && pwd)"
exec 9> "$out/lock" # held by all that is started here
flock -n 9 || fail "another run is writing to $out"
repeat="${REPEAT:-3}"
limit="${LIMIT:-600}"
max_faces="${MAX_FACES:-7000000}"
[ -z "${HLSCM_BIN:-}" ] || HLSCM_BIN="$(cd "$HLSCM_BIN" && pwd)"
[ -z "${HLSCM_DATA_DIR:-}" ] || HLSCM_DATA_DIR="$(cd "$HLSCM_DATA_DIR" && pwd)"
cd "$root"

if [ -z "${HLSCM_BIN:-}" ]; then
  scripts/install_dependencies.sh --bench
  say "building"
  cmake --preset bench >&2
  cmake --build --preset bench --parallel "$(number_of_jobs)" >&2
  HLSCM_BIN="$root/build/bench/bin"
fi
export HLSCM_DATA_DIR="${HLSCM_DATA_DIR:-$(scripts/debian_meshes.sh "$charts/meshes")}"

print_machine() {
  date --iso-8601=seconds
  uname -srm
  lscpu | grep -E '^(Model name|CPU\(s\)|Thread|L[0-9]|Hypervisor)' || true
  grep -E '^Mem(Total|Available)' /proc/meminfo
  echo "load of the last minute: $(cut -d ' ' -f 1 /proc/loadavg)"
}

# chart NAME INPUT OPTIONS...: makes CHARTS_DIR/NAME.ply if it is not there. NAME ends in _Nk for N
# thousand faces.
chart() {
  local name="$1" input="$2" thousands
  shift 2
  thousands="${name##*_}"
  [ "${thousands%k}000" -le "$max_faces" ] || return 0
  [ -e "$charts/$name.ply" ] && return 0
  say "making $name"
  "$HLSCM_BIN/make_chart" "$input" -o "$charts/$name.unfinished.ply" "$@" >&2
  mv "$charts/$name.unfinished.ply" "$charts/$name.ply"
}

# Charts that differ from those of the series that side_by_side makes itself: in shape, border,
# triangles, order.
make_charts() {
  local data="$HLSCM_DATA_DIR"
  chart lion_head_17k "$data/lion-head.off"
  chart armadillo_52k "$data/armadillo.off" --cut
  chart armadillo_832k "$data/armadillo.off" --cut --loop 2 --noise 0.1
  chart lion_head_1067k "$data/lion-head.off" --loop 3 --noise 0.1
  chart bunny00_1207k "$data/bunny00.off" --cut --loop 2 --noise 0.1
  chart lion_borders_951k "$data/lion.off" --loop 3 --noise 0.1
  chart jagged_lion_1060k "$data/lion-head.off" --loop 3 --noise 0.1 --jagged 20
  chart anisotropic_devil_1000k "$data/mannequin-devil.off" --stretch 8 --faces 1000000 --noise 0.02
  chart terrain_1000k grid:2000x250
  chart bunny00_shuffled_1207k "$data/bunny00.off" --cut --loop 2 --noise 0.1 --shuffle
}

# Two families of one shape each, from 0.1 to 10 million faces, in a folder of their own.
make_scaling_charts() {
  local data="$HLSCM_DATA_DIR"
  mkdir -p "$charts/scaling"
  chart scaling/terrain_100k grid:224x224 --noise 0.1
  chart scaling/terrain_405k grid:450x450 --noise 0.1
  chart scaling/terrain_1003k grid:708x708 --noise 0.1
  chart scaling/terrain_5120k grid:1600x1600 --noise 0.1
  chart scaling/terrain_10035k grid:2240x2240 --noise 0.1
  chart scaling/bunny00_75k "$data/bunny00.off" --cut --noise 0.1
  chart scaling/bunny00_302k "$data/bunny00.off" --cut --loop 1 --noise 0.1
  chart scaling/bunny00_1207k "$data/bunny00.off" --cut --loop 2 --noise 0.1
  chart scaling/bunny00_4826k "$data/bunny00.off" --cut --loop 3 --noise 0.1
}

make_chart_for_pins() {
  mkdir -p "$charts/pins"
  chart pins/lion_head_267k "$HLSCM_DATA_DIR/lion-head.off" --loop 2 --noise 0.1
}

# All charts of the folder but those of the series and of table 1, by size.
other_charts() {
  local file thousands
  find "$charts" -maxdepth 1 -name '*_*k.ply' -printf '%s %p\n' | sort -n | cut -d ' ' -f 2- |
    grep -Ev '/((devil|camel)_[0-9]+k|bunny_1120k)\.ply$' |
    while read -r file; do
      thousands="${file##*_}"
      [ "${thousands%k.ply}000" -gt "$max_faces" ] || echo "$file"
    done
}

# compare NAME ARGUMENTS...: OUT/NAME.csv, and the tables in OUT/NAME.txt
compare() {
  local name="$1" memory
  shift
  say "$name"
  memory="$(awk '/^MemAvailable:/ { printf "%.1f", 0.9 * $2 * 1024e-9 }' /proc/meminfo)"
  "$HLSCM_BIN/side_by_side" "$@" --repeat "$repeat" --limit "$limit" --memory-limit "$memory" \
    --chart-dir "$charts" --max-faces "$max_faces" --resume -o "$out/$name.csv" |
    tee -a "$out/$name.txt"
}

run_kernels() {
  [ -e "$out/kernels.json" ] && return 0
  say "kernels"
  "$HLSCM_BIN/kernels" --benchmark_repetitions="$repeat" --benchmark_report_aggregates_only=true \
    --benchmark_out="$out/kernels.unfinished" --benchmark_out_format=json |
    grep -Ev '_(mean|stddev) ' | tee "$out/kernels.txt"
  mv "$out/kernels.unfinished" "$out/kernels.json"
}

print_machine | tee -a "$out/machine.txt"
awk '$1 > 0.5 { exit 1 }' /proc/loadavg || say "the machine is busy: times will be too long"
make_charts
make_scaling_charts
make_chart_for_pins
run_kernels
compare side_by_side
mapfile -t others < <(other_charts)
compare other_charts "${others[@]}" --methods \
  direct,cgal_lscm_cholmod,cgal_lscm_default,cascadic,hlscm_1e-2,hlscm_1e-4
compare table_1 --table1
mapfile -t scaling < <(find "$charts/scaling" -name '*_*k.ply' | sort -V)
compare scaling "${scaling[@]}" --methods hlscm_1e-2,hlscm_1e-2_2_threads
max_faces=$((max_faces < 2000000 ? max_faces : 2000000))
compare decimation --decimation
"$HLSCM_BIN/flip_repair" "$HLSCM_DATA_DIR"/{lion-head,mannequin-devil}.off > "$out/flip_repair.csv"
mapfile -t large < <(find "$charts" -maxdepth 1 -name '*_1[0-9][0-9][0-9]k.ply' | sort)
"$HLSCM_BIN/live_map" "${large[@]}" > "$out/live_map.csv"
"$HLSCM_BIN/pins" "$charts"/pins/*.ply "${large[@]}" > "$out/pins.csv"
"$HLSCM_BIN/low_stretch_benchmark" "${large[@]}" > "$out/low_stretch.csv"
"$HLSCM_BIN/signals" --size 256 512 --weight 1 2 4 8 16 -- \
  "$HLSCM_DATA_DIR"/{armadillo,blade,bunny00,camel,cow,diplodocus,fandisk,hand,homer,mannequin-devil}.off \
  > "$out/signals_tuning.csv"
"$HLSCM_BIN/signals" --size 256 512 -- \
  "$HLSCM_DATA_DIR"/{bear,bull,cactus,ChineseDragon-10kv,dino,elephant,femur,head,lion-head,retinal}.off \
  > "$out/signals.csv"
"$HLSCM_BIN/low_stretch_benchmark" "${large[@]}" --one-to-one > "$out/one_to_one.csv"
"$HLSCM_BIN/low_stretch_benchmark" "${others[@]}" --estimates > "$out/low_stretch_estimates.csv"
"$HLSCM_BIN/decimate" "${large[@]}" > "$out/decimate.csv"
"$HLSCM_BIN/equations" > "$out/equations.csv"
"$HLSCM_BIN/equations" --vertices 1000000 >> "$out/equations.csv"
"$HLSCM_BIN/equations" --vertices 4000000 --no-peers >> "$out/equations.csv"
"$HLSCM_BIN/levels" "${large[@]}" > "$out/levels.csv"
"$HLSCM_BIN/baking" "${large[@]}" > "$out/baking.csv"
"$HLSCM_BIN/packing" > "$out/packing.csv"
{
  "$HLSCM_BIN/atlases" --threads 0 "$HLSCM_DATA_DIR"/{bunny00,armadillo,camel}.off
  "$HLSCM_BIN/atlases" --threads 0 --loop 2 "$HLSCM_DATA_DIR"/{bunny00,armadillo}.off | grep -v '^[#m]'
} > "$out/atlases.csv"
"$HLSCM_BIN/stages" "${large[@]}" > "$out/stages.csv"
"$HLSCM_BIN/parameters" --repeat "$repeat" "$charts/camel_313k.ply" \
  "$charts/scaling/bunny00_302k.ply" > "$out/parameters.csv"
mapfile -t disks < <(find "$charts" -maxdepth 1 \
  \( -name armadillo_52k.ply -o -name lion_head_1067k.ply \) | sort)
"$HLSCM_BIN/swimming" "$HLSCM_DATA_DIR"/{lion-head,mannequin-devil}.off "${disks[@]}" \
  > "$out/swimming.csv"
# Debian's python3 has matplotlib; another one that comes first may not.
python="$(command -v /usr/bin/python3 || command -v python3)"
for name in side_by_side other_charts; do
  "$python" benchmark/plot.py "$out/$name.csv" -o "$out/$name.png"
done
"$python" benchmark/plot_parameters.py "$out/parameters.csv" -o "$out/parameters.png"
"$python" benchmark/compile_time.py > "$out/compile_time.csv"
print_machine >> "$out/machine.txt"
say "done: $out"
