% SPDX-License-Identifier: Apache-2.0
% run_tests  Tests of the package for MATLAB, without any toolbox: ./dev octave
%
%   addpath bindings/matlab build/release/matlab
%   run tests/matlab/run_tests.m
%
% Ends in an error if a test fails. The environment variable MICROSWARM names the program.
function run_tests()
  here = fileparts(mfilename('fullpath'));
  root = fileparts(fileparts(here));
  addpath(here, fullfile(root, 'examples', 'matlab'));
  folders = strsplit(path(), pathsep());  % found from other folders, too
  path(strjoin([folders(1), cellfun(@make_absolute_filename, folders(2:end), 'UniformOutput', false)], pathsep()));
  world.scenarios = fullfile(root, 'scenarios');
  world.flight = fullfile(world.scenarios, 'first_flight.yaml');
  world.program = getenv('MICROSWARM');
  if isempty(world.program), world.program = fullfile(root, 'build', 'release', 'bin', 'microswarm'); end
  world.folder = tempname();
  mkdir(world.folder);

  files = dir(fullfile(here, 'test_*.m'));
  tests = {};
  for k = 1:numel(files)
    part = feval(files(k).name(1:end - 2));
    tests = [tests, part];  %#ok<AGROW>
  end
  failed = 0;
  for k = 1:numel(tests)
    name = func2str(tests{k});
    try
      tests{k}(world);
      fprintf('passed  %s\n', name);
    catch problem
      failed = failed + 1;
      fprintf('FAILED  %s: %s\n', name, problem.message);
      for place = problem.stack'
        fprintf('        %s:%d\n', place.name, place.line);
      end
    end
  end
  fprintf('%d of %d tests passed\n', numel(tests) - failed, numel(tests));
  if failed > 0, error('%d tests failed', failed); end
end
