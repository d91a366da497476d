% SPDX-License-Identifier: Apache-2.0
function tests = test_pages()
% test_pages  Programs that stand on a page are those of the examples.
  tests = {@the_loop_on_the_page_is_the_example};
end

function the_loop_on_the_page_is_the_example(world)
  root = fileparts(world.scenarios);
  page = fileread(fullfile(root, 'docs', 'how-to', 'use-from-matlab.md'));
  example = fileread(fullfile(root, 'examples', 'matlab', 'camera_loop.m'));
  code = example(find(example == char(10), 1) + 1:end);  % without the licence
  assert(~isempty(strfind(page, [char(10) '```matlab' char(10) code '```' char(10)])));
end
