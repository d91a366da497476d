% SPDX-License-Identifier: Apache-2.0
function tests = test_pages()
% test_pages  Every block of MATLAB on a page runs; stand_in/ has what Octave lacks.
  tests = {@the_loop_on_the_page_is_the_example, @every_block_on_a_page_runs};
end

function the_loop_on_the_page_is_the_example(world)
  root = fileparts(world.scenarios);
  blocks = blocks_of(fullfile(root, 'docs', 'how-to', 'use-from-matlab.md'));
  example = fileread(fullfile(root, 'examples', 'matlab', 'camera_loop.m'));
  assert(strcmp([char(10) blocks{1}], example(find(example == char(10), 1):end)));  % without the licence
end

function every_block_on_a_page_runs(world)
  root = fileparts(world.scenarios);
  folder = fullfile(world.folder, 'pages');
  mkdir(folder);
  copyfile(world.flight, fullfile(folder, 'chip.yaml'));
  assert(symlink(world.scenarios, fullfile(folder, 'scenarios')) == 0);
  stand_in = fullfile(root, 'tests', 'matlab', 'stand_in');
  shadows = warning('off', 'Octave:shadowed-function');
  addpath(stand_in);
  warning(shadows);
  back = cd(folder);
  restore = onCleanup(@() leave(stand_in, back));
  program(world, 'run scenarios/first_flight.yaml --set time_limit_s=5 --out out/first');
  copyfile('out/first/run.h5', 'run.h5');
  program(world, 'sweep scenarios/sweeps/first_flight.yaml --out first_flight.db');
  program(world, 'export first_flight.db --hdf5 trials.h5');
  count = 0;
  for page = pages_below(fullfile(root, 'docs'))
    blocks = blocks_of(page{1});
    for k = 1:numel(blocks)
      run_block(world, page{1}(numel(root) + 2:end), k, blocks{k});
      count = count + 1;
    end
  end
  fprintf('        %d blocks on pages\n', count);
  assert(count >= 8);
end

function run_block(world, page, k, block)
  global simulated
  switch sprintf('%s %d', page, k)
    case 'docs/how-to/use-from-matlab.md 1'  % is the example, which test_navigator runs
    case 'docs/how-to/use-from-matlab.md 2'
      simulated = simulated_rig([200 500], 4.2);
      ended = last_value(block);
      assert(strcmp(ended.state, 'arrived') && norm(simulated.place() - [1800 500]) < 60);
    case 'docs/how-to/use-from-matlab.md 3'
      build_on_a_copy(world, block);
    case 'docs/how-to/use-from-matlab.md 4'
      picture = uint8(200) * ones(60, 80, 'uint8');
      eval(block);
      assert(strcmp(result.status, 'solved') && numel(result.frames.x_um) > 10);
      assert(path.solved && abs(path.length_um - 300) < 1e-6);
    case 'docs/how-to/sweep.md 1'
      assert(last_value(block) > 10);
    case {'docs/reference/record.md 1', 'docs/tutorials/first-run.md 1'}
      eval(block);
    case 'docs/reference/line-protocol.md 1'
      daq_session = containers.Map('output', []);
      eval(block);
      assert(isequal(daq_session('output'), [1 -2]));
    otherwise
      error('%s: no test runs block %d', page, k);
  end
end

function ans = last_value(block)  %#ok<NOANS>
% The value that a block ends with, which it prints.
  said = evalc(block);  %#ok<NASGU>
end

function build_on_a_copy(world, block)
% Runs a block in an Octave of its own, in a copy of what it needs of the source.
  root = fileparts(world.scenarios);
  mkdir('copy');
  mkdir(fullfile('copy', 'bindings'));
  for part = {'c', 'matlab'}
    copyfile(fullfile(root, 'bindings', part{1}), fullfile('copy', 'bindings', part{1}));
  end
  mkdir(fullfile('copy', 'build'));
  assert(symlink(fileparts(fileparts(world.program)), fullfile('copy', 'build', 'release')) == 0);
  stream = fopen(fullfile('copy', 'block.m'), 'w');
  fprintf(stream, '%s', block);
  fclose(stream);
  [failed, said] = system('cd copy && octave-cli --no-gui --norc --no-history block.m 2>&1');
  assert(failed == 0 && ~isempty(strfind(said, microswarm.version())), said);
end

function pages = pages_below(folder)
% All pages of a folder and those within.
  pages = {};
  for one = dir(folder)'
    place = fullfile(folder, one.name);
    if one.isdir && one.name(1) ~= '.'
      pages = [pages, pages_below(place)];  %#ok<AGROW>
    elseif ~isempty(regexp(one.name, '\.md$', 'once'))
      pages{end + 1} = place;  %#ok<AGROW>
    end
  end
end

function blocks = blocks_of(page)
  blocks = regexp(fileread(page), '(?<=\n)```matlab\n(.*?\n)```\n', 'tokens');
  blocks = cellfun(@(one) one{1}, blocks, 'UniformOutput', false);
end

function program(world, arguments)
  [failed, said] = system(['"' world.program '" ' arguments ' 2>&1']);
  assert(failed == 0 || failed == 3, said);
end

function leave(stand_in, back)
  rmpath(stand_in);
  cd(back);
end
