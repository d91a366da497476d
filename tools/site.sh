# SPDX-License-Identifier: Apache-2.0
# Read by ./dev: the lab as static files.

# site: any server of files shows it; python3 -m http.server --directory build/site
site() {
  ready site
  build
  wasm_sources
  configure wasm
  compile wasm microswarm_lab
  node web/site.mjs build/release/bin/microswarm build/wasm/bin/microswarm_lab.wasm build/site
  echo "./dev: build/site: the module has $(gzip -9 -c build/site/lab.wasm | wc -c) bytes gzipped"
}

# wasm_sources: what Debian builds no library of for WebAssembly, in build/sources: source packages, and the objects of
# emscripten's libc++abi and libunwind that throw and catch exceptions, which Debian's libc++abi for it lacks.
wasm_sources() {
  local package folder=build/sources objects=build/sources/exceptions
  mkdir -p "$folder"
  for package in hdf5 libpolyclipping yaml-cpp zlib; do
    [ -d "$folder/$package" ] || unpack_source "$package" "$folder"
  done
  [ -d "$objects" ] || (
    cd "$folder"
    download emscripten
    mkdir -p exceptions.tmp
    dpkg-deb --fsys-tarfile emscripten_*.deb | tar -x -C exceptions.tmp --strip-components=8 \
      ./usr/share/emscripten/cache/sysroot/lib/wasm32-emscripten/lib{c++abi,unwind}-except.a
    (cd exceptions.tmp && llvm-ar-19 x libc++abi-except.a cxa_exception.o cxa_exception_storage.o cxa_personality.o &&
      llvm-ar-19 x libunwind-except.a Unwind-wasm.o)
    rm emscripten_*.deb exceptions.tmp/*.a
    mv exceptions.tmp exceptions
  )
}

# unpack_source PACKAGE FOLDER: a source package of the configured archives, with Debian's patches, as FOLDER/PACKAGE.
unpack_source() {
  local apt_folder=$2/apt
  local get=(apt-get -qq -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$PWD/$apt_folder/parts"
    -o "Dir::State::lists=$PWD/$apt_folder/lists" -o APT::Sandbox::User=)
  if [ ! -d "$apt_folder/lists" ]; then
    mkdir -p "$apt_folder/parts" "$apt_folder/lists"
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
      [ ! -f "$file" ] || sed 's/^Types: deb$/Types: deb-src/; s/^deb /deb-src /' "$file" >"$apt_folder/parts/${file##*/}"
    done
    "${get[@]}" update
  fi
  rm -rf "$2/unpacked"
  mkdir "$2/unpacked"
  (cd "$2/unpacked" && "${get[@]}" source "$1" >/dev/null)
  mv "$2"/unpacked/*/ "$2/$1"
  rm -r "$2/unpacked"
}

# The static lab in node and in a real browser.
test_site() {
  ready web_site
  site
  MICROSWARM=$PWD/build/release/bin/microswarm node --test web/tests/site.test.mjs
}
