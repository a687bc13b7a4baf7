#!/bin/sh
# Fuzzes the keyword reader and the model builder: run.sh [seconds]. Needs clang and its libFuzzer (Debian: clang,
# libclang-rt-14-dev). New finds go to build/fuzz/corpus, crashes to build/fuzz; a crash that is cured becomes a seed.
set -eu
seconds=${1:-600}
root=$(cd "$(dirname "$0")/../.." && pwd)
out=$root/build/fuzz
cxx=$(command -v clang++ || command -v clang++-14)
mkdir -p "$out/corpus"
cmake -DINPUT="$root/src/kardan/io/deck/schema/keywords.tsv" -DOUTPUT="$out/keyword_table.cpp" -P "$root/cmake/EmbedText.cmake"
flags="-std=c++20 -O2 -g1 -fno-omit-frame-pointer -DFMT_HEADER_ONLY -I$root/src -DKARDAN_FUZZ_SEEDS=\"$root/tests/fuzz/seeds\""
# isa.cpp asks the processor for x86-64-v2 … v4 by name, which clang knows from 17 on; the reader does not use it.
sources="$out/keyword_table.cpp $root/tests/fuzz/deck_fuzz.cpp \
  $(find "$root/src/kardan/base" "$root/src/kardan/model" "$root/src/kardan/io/deck" -name '*.cpp' ! -name isa.cpp)"
objects=
todo=
for source in $sources; do
  object=$out/$(echo "${source#"$root"/}" | tr / _).o
  objects="$objects $object"
  # Rebuilt if it or any header is newer.
  if [ ! -e "$object" ] || [ -n "$(find "$root/src/kardan" "$root/tests/fuzz" "$source" \( -name '*.hpp' -o -path "$source" \) \
      -newer "$object" -type f | head -n 1)" ]; then
    todo="$todo $source $object"
  fi
done
# shellcheck disable=SC2086
[ -z "$todo" ] || printf '%s -o %s\n' $todo | xargs -P 2 -L 1 nice "$cxx" $flags -fsanitize=fuzzer-no-link,address,undefined \
  -fno-sanitize-recover=undefined -c
# shellcheck disable=SC2086
"$cxx" $flags -fsanitize=fuzzer,address,undefined $objects -o "$out/deck_fuzz" -lspdlog
cd "$out"
exec nice ./deck_fuzz -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 -max_len=8192 -print_final_stats=1 \
  -dict="$root/tests/fuzz/deck.dict" corpus "$root/tests/fuzz/seeds"
