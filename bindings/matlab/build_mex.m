function file = build_mex(library_folder, output_folder)
% build_mex  Compiles microswarm_mex for MATLAB or Octave.
%
%   build_mex()
%   file = build_mex(library_folder, output_folder)
%
% library_folder   folder of libmicroswarm_c.so; default: ../../build/release/lib from this file, or its
%                  place in an installation
% output_folder    folder for the MEX file; default: that of this file
%
% Needs a C compiler: in MATLAB see `mex -setup C`, in Octave the package octave-dev of Debian.
% Afterwards: addpath of this folder, and of output_folder if it is another one.
% An error says that the library is missing, or repeats the compiler's message.

  % SPDX-License-Identifier: Apache-2.0
  here = fileparts(mfilename('fullpath'));
  if nargin < 1 || isempty(library_folder)
    library_folder = first_with('libmicroswarm_c.so', fullfile(here, '..', '..', 'build', 'release', 'lib'), ...
                                fullfile(here, '..', '..', '..', 'lib'));
  end
  if nargin < 2 || isempty(output_folder), output_folder = here; end
  if exist(fullfile(library_folder, 'libmicroswarm_c.so'), 'file') ~= 2
    error('microswarm:bad_input', ...
          '%s has no libmicroswarm_c.so; ./dev octave or cmake --build build/release --target microswarm_c makes it', ...
          library_folder);
  end
  [~, place] = fileattrib(library_folder);  % whole path, for the loader
  library_folder = place.Name;
  if exist(output_folder, 'dir') ~= 7, mkdir(output_folder); end
  source = fullfile(here, 'microswarm_mex.c');
  headers = ['-I' first_with('microswarm.h', fullfile(here, '..', 'c'), fullfile(here, '..', '..', '..', 'include'))];
  file = fullfile(output_folder, ['microswarm_mex.' mexext()]);
  if exist('OCTAVE_VERSION', 'builtin')
    [said, code] = mkoctfile('--mex', '-Wall', '-Wextra', headers, source, ['-L' library_folder], ...
                             '-lmicroswarm_c', ['-Wl,-rpath,' library_folder], '-o', file);
    if code ~= 0, error('microswarm:bad_input', 'mkoctfile failed: %s', said); end
  else
    mex('-R2018a', headers, source, ['-L' library_folder], '-lmicroswarm_c', ...
        ['LDFLAGS=$LDFLAGS -Wl,-rpath,' library_folder], '-outdir', output_folder);
  end
end

function folder = first_with(file, one, other)
% The folder of the two that holds the file; the first, if neither does.
  folder = one;
  if exist(fullfile(one, file), 'file') ~= 2 && exist(fullfile(other, file), 'file') == 2
    folder = other;
  end
end
