#!/usr/bin/env bash
# Installs those Debian packages of the given list that are not on this machine: install_packages.sh packages.txt
set -euo pipefail
mapfile -t wanted < <(grep -v '^\s*#' "$1" | sed 's/\s*$//' | grep .)
missing=()
for package in "${wanted[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0
echo "installing Debian packages: ${missing[*]}"
run() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }
export DEBIAN_FRONTEND=noninteractive
run apt-get update -q
run apt-get install -q -y --no-install-recommends "${missing[@]}"
