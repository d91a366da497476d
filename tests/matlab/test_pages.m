% SPDX-License-Identifier: Apache-2.0
function tests = test_pages()
% test_pages  Programs that stand on a page are those of the examples.
  tests = {@the_loop_on_the_page_is_the_example, @runs_and_paths_on_the_page_run};
end

function the_loop_on_the_page_is_the_example(world)
  root = fileparts(world.scenarios);
  page = fileread(fullfile(root, 'docs', 'how-to', 'use-from-matlab.md'));
  example = fileread(fullfile(root, 'examples', 'matlab', 'camera_loop.m'));
  code = example(find(example == char(10), 1) + 1:end);  % without the licence
  assert(~isempty(strfind(page, [char(10) '```matlab' char(10) code '```' char(10)])));
end

function runs_and_paths_on_the_page_run(world)
  root = fileparts(world.scenarios);
  page = fileread(fullfile(root, 'docs', 'how-to', 'use-from-matlab.md'));
  found = regexp(page, ['```matlab' char(10) '(result = microswarm\.run.*?)```'], 'tokens', 'once');
  lines = strsplit(found{1}, char(10));
  lines = lines(~strncmp(lines, 'plot(', 5));
  picture = uint8(200) * ones(60, 80, 'uint8');
  back = cd(root);
  restore = onCleanup(@() cd(back));
  eval(strjoin(lines, char(10)));
  assert(strcmp(result.status, 'solved') && numel(result.frames.x_um) > 10);
  assert(path.solved && abs(path.length_um - 300) < 1e-6);
end
