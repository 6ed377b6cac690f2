#!/usr/bin/env bash
# Installs a build of ringlet and uses what was installed as a stranger does: find_package with every compiler there is,
# and pkg-config. Then what a build lacks is left out.
#   installed_test.sh BUILD_FOLDER GENERATOR static|shared
set -euo pipefail
build=$1 generator=$2 kind=$3
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
fail() { echo "installed_test ($kind): $*" >&2; exit 1; }

cmake --install "$build" --prefix "$prefix" > "$work/install.txt" || { cat "$work/install.txt"; exit 1; }
libraries=("$prefix"/lib/libringlet_core.* "$prefix"/lib/libringlet_io.*)

# A host may have a volk of its own.
names=$(nm -g --defined-only -- "${libraries[@]}" 2> /dev/null | grep -E ' (vk|volk)[A-Z]' | head -n 3 || true)
[ -z "$names" ] || fail "names of volk are shown: $names"
if [ "$kind" = shared ]; then
  names=$(nm -D -C --defined-only -- "${libraries[@]}" | grep -E '^[0-9a-f]' |
    grep -vE '^[0-9a-f]+ . (ringlet_[a-uw-z][a-z_]*$|ringlet_v(ersion|elocities)$|ringlet::|(typeinfo( name)?|vtable) for ringlet::)' | head -n 3 || true)
  [ -z "$names" ] || fail "a shared library shows names that are not Ringlet's: $names"
fi

compilers=0
for compiler in g++ clang++; do
  command -v $compiler > /dev/null || { echo "SKIPPED: $compiler is not installed"; continue; }
  cc=$([ $compiler = g++ ] && echo gcc || echo clang)
  cmake -S "$here/installed" -B "$work/$compiler" -G "$generator" -DCMAKE_CXX_COMPILER=$compiler -DCMAKE_C_COMPILER=$cc -DCMAKE_C_FLAGS="-Wall -Wextra -Werror" \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" > "$work/$compiler.txt" &&
    cmake --build "$work/$compiler" >> "$work/$compiler.txt" || { cat "$work/$compiler.txt"; fail "$compiler"; }
  for program in simulates reads_and_writes includes_all plain_c; do
    (cd "$work" && "$work/$compiler/$program") || fail "$program, compiled with $compiler"
  done
  # The programs of docs/library.md, of curl.hair, which reads_and_writes left: C and C++ write the same bytes.
  for ending in usda usdc rgc pc2; do
    for language in c cpp; do
      (cd "$work" && "$work/$compiler/film_in_$language" curl.hair $language.$ending) || fail "film.$language, compiled with $compiler"
    done
    cmp "$work/c.$ending" "$work/cpp.$ending" || fail "film.c and film.cpp write other animations"
  done
  compilers=$((compilers + 1))
done
[ $compilers -gt 0 ] || fail "no compiler"

# The lines of the table in docs/library.md, with files of the names that stand there; and a project in C alone.
mkdir "$work/table"
cp "$work/cpp.usdc" "$work/table/hair.usdc"
cp "$work/curl.hair" "$work/table"
cd "$work/table"
printf 'preset = "coil"\n[dials]\nhold = 2\n' > curls.toml
printf '[groom]\nfile = "curl.hair"\n[motion]\nkind = "shake"\npre_roll = 0.05\n[simulation]\nframes = 2\n[[body]]\nshape = "sphere"\nradius = 0.01\nposition = [0, 1, 0]\n' > scene.toml
printf 'v 0 90 0\nv 10 90 0\nv 0 100 0\nv 0 90 10\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' > head.obj
printf 'HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\nJOINT Head\n{\nOFFSET 0 150 0\nCHANNELS 1 Zrotation\nEnd Site\n{\nOFFSET 0 20 0\n}\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.04\n0 0\n1 0\n' > walk.bvh
cd "$work"
cc=$(command -v gcc || command -v clang)
cmake -S "$here/installed_c" -B "$work/c_alone" -G "$generator" -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="-Wall -Wextra -Werror" \
  -DCMAKE_PREFIX_PATH="$prefix" > "$work/c_alone.txt" && cmake --build "$work/c_alone" >> "$work/c_alone.txt" ||
  { cat "$work/c_alone.txt"; fail "a project in C alone"; }
(cd "$work" && "$work/c_alone/plain_c" && "$work/c_alone/film_in_c" curl.hair c_alone.usda) || fail "a program of a project in C alone"
cmp "$work/c_alone.usda" "$work/cpp.usda" || fail "a project in C alone writes another animation"
for program in "$work"/*/table_in_cpp "$work"/*/table_in_c; do
  rm -rf "$work"/table/{hair.ply,hair.rgc,out,out_of_c}
  (cd "$work/table" && "$program") || fail "the table of library.md: $program"
  [ -s "$work/table/hair.ply" ] && [ -s "$work/table/hair.rgc" ] || fail "$program leaves no files"
done

# A component that is not installed is asked for in vain.
cat > "$work/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.25)
project(asks_for_more LANGUAGES CXX)
find_package(ringlet REQUIRED COMPONENTS core moon)
END
! cmake -S "$work" -B "$work/moon" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" > "$work/moon.txt" 2>&1 ||
  fail "find_package finds a component that there is not"
grep -q moon "$work/moon.txt" || fail "find_package does not name the component: $(cat "$work/moon.txt")"

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
flags=$([ "$kind" = static ] && echo --static || true)
g++ -std=c++20 "$here/installed/reads_and_writes.cpp" $(pkg-config --cflags --libs $flags ringlet-io) -o "$work/by_pkg_config"
(cd "$work" && LD_LIBRARY_PATH=$prefix/lib ./by_pkg_config) || fail "what pkg-config says"
# A program in C is linked by the C compiler.
gcc -std=c99 "$here/installed/plain_c.c" $(pkg-config --cflags --libs $flags ringlet-core) -lm -o "$work/c_by_pkg_config"
(cd "$work" && LD_LIBRARY_PATH=$prefix/lib ./c_by_pkg_config) || fail "what pkg-config says to a C compiler"
gcc -std=c99 "$here/installed/film.c" $(pkg-config --cflags --libs $flags ringlet-io) -lm -o "$work/film_by_pkg_config"
(cd "$work" && LD_LIBRARY_PATH=$prefix/lib ./film_by_pkg_config curl.hair by_pkg_config.usda) || fail "what pkg-config says to a C compiler of ringlet-io"

# Of a tree of which a part was built that part is installed, and a line names what is not. The rules are the build's own,
# with what each case lacks at a place where it is not.
#   install_without CASE FILE SENTENCE: as if FILE of the build, or all of that folder, were not there
install_without() {
  local lacking=$work/lacking_$1 script
  while read -r script; do
    mkdir -p "$lacking/$(dirname "${script#"$build"/}")"
    sed -e "s|\"$build/\(.*/\)\?cmake_install.cmake\"|\"$lacking/\1cmake_install.cmake\"|" \
      -e "s|$build/$2|$lacking/absent/$2|g" "$script" > "$lacking/${script#"$build"/}"
  done < <(find "$build" -name cmake_install.cmake -not -path '*/Testing/*' -not -path "$build/tests/consumer/*")
  cmake --install "$lacking" --prefix "$lacking/prefix" > "$lacking.txt" 2>&1 || return 1
  grep -q "$3" "$lacking.txt" || fail "install without $2 does not say '$3': $(cat "$lacking.txt")"
}
if [ "$kind" = static ] && [ -e "$build/python" ] && [ -x "$build/ringlet" ]; then
  install_without module python "Not installed: the Python module, which" || fail "no install without the Python module: $(cat "$work/lacking_module.txt")"
  [ -x "$work/lacking_module/prefix/bin/ringlet" ] || fail "without the Python module the command is not installed"
  [ ! -e "$work/lacking_module/prefix/lib/python3.11" ] || fail "a folder for a module that there is not"
  install_without stubs python/ringlet-stubs "Not installed: the Python module's type stubs" || fail "no install without stubs"
  install_without command 'ringlet"' "Not installed: the ringlet command" || fail "no install without the command"
  [ -e "$work/lacking_command/prefix/lib/cmake/ringlet/ringletConfig.cmake" ] || fail "without the command the library is not installed"
  install_without io src/libringlet_io "Not installed: ringlet::io" || fail "no install without ringlet::io"
  sed -i 's/ moon//' "$work/CMakeLists.txt"
  cmake -S "$work" -B "$work/core_only" -G "$generator" -DCMAKE_PREFIX_PATH="$work/lacking_io/prefix" > "$work/core_only.txt" 2>&1 ||
    fail "find_package does not find core without io: $(cat "$work/core_only.txt")"
  ! install_without core src/libringlet_core "nothing to install" || fail "an install of nothing succeeds"
  [ ! -e "$work/lacking_core/prefix" ] || fail "an install of nothing leaves files: $(find "$work/lacking_core/prefix")"
  grep -q "There is nothing to install" "$work/lacking_core.txt" || fail "an install of nothing says: $(cat "$work/lacking_core.txt")"
fi
for module in "$prefix"/lib/python3*/*-packages; do
  [ -d "$module" ] || continue  # it was not built
  (cd "$work" && PYTHONPATH=$module /usr/bin/python3 -c 'import ringlet; ringlet.make_curl().write("module.obj")') || fail "the Python module"
  [ -s "$module/ringlet-stubs/__init__.pyi" ] || fail "the Python module has no stubs"
done
if [ -x "$prefix/bin/ringlet" ]; then
  (cd "$work" && "$prefix/bin/ringlet" make curl -o curl.obj > make.txt) || fail "the installed command"
fi
