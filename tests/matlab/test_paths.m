% SPDX-License-Identifier: Apache-2.0
function tests = test_paths()
% test_paths  Maps and paths.
  tests = {@maps_of_matrices, @grey_pictures_have_the_walls_of_their_files, @values_of_maps, ...
           @paths_round_a_wall, @bad_maps_and_paths};
end

function free = room()
  free = true(20, 40);       % 400 um x 200 um, with a wall that leaves 50 um at the top
  free(6:20, 19:22) = false;
end

function maps_of_matrices(world)
  map = microswarm.Map(room(), 10);
  assert(isequal(map.bounds(), [0 0 400 200]));
  assert(isequal(map.clearance([50 50; 200 50; 200 180]), [50; 0; 20]));
  assert(isequal(size(map.clearance([])), [0 1]));
  grey = microswarm.Map(uint8(200) * uint8(room()), 10);
  assert(isequal(grey.clearance([50 50; 200 50; 200 180]), [50; 0; 20]));
  map.close();
  refuses(@() map.bounds(), 'bad_call', 'closed');
end

function grey_pictures_have_the_walls_of_their_files(world)
  grey = uint8(200) * ones(60, 80, 'uint8');  % the wall is dark, not black
  grey(10:60, 38:42) = 20;
  file = fullfile(world.folder, 'grey.pgm');
  stream = fopen(file, 'w');
  fprintf(stream, 'P5 80 60 255\n');
  fwrite(stream, grey');
  fclose(stream);
  plan = @(map) microswarm.plan(map, [50 50], [750 50], 'um_per_px', 10, 'clearance_um', 15);
  read = plan(file);
  assert(abs(read.length_um - 1206) < 1);  % over the wall; through it are 700 um
  for picture = {grey, grey >= 128, uint8(grey >= 128)}
    path = plan(picture{1});
    assert(path.solved && path.length_um == read.length_um);
  end
  at = @(brightness) microswarm.Map(uint8([255 brightness 255]), 10).clearance([15 5]);
  assert(at(127) == 0 && at(128) == 5);
end

function values_of_maps(world)
  at = @(varargin) microswarm.Map(varargin{:}).clearance([5 5; 15 5]);
  grey = uint8([90 89]);  % free at the left
  free = [5; 0];
  assert(isequal(at(grey, 10, 'threshold', 90), free));
  assert(isequal(at(grey, 10, 'threshold', 90, 'free', 'dark'), flipud(free)));
  assert(isequal(at(uint8([0 255]), 10, 'free', 'dark'), free));
  assert(isequal(at(uint8([0 1]), 10, 'free', 'dark'), free));
  assert(isequal(at([false true], 10, 'free', 'dark'), free));
  assert(isequal(at([true false], 10, 'threshold', 90), free));
  assert(isequal(at([1 0], 10), free));  % a mask of class double
  assert(isequal(at(int32([0 1]), 10, 'free', 'dark'), free));
  assert(isequal(at([0.5 0.4], 10, 'threshold', 0.45), free));
  assert(isequal(at(uint16([4000 3000]), 10, 'threshold', 3500), free));
  refuses(@() at(grey, 10, 'threshold', 'high'), 'bad_input', 'threshold must be a number');
  refuses(@() at(grey, 10, 'free', 'darkk'), 'bad_input', 'bright or dark, not darkk');
  refuses(@() at(grey, 10, 'wall', 'one'), 'bad_input', 'wall is no value of a matrix');
  refuses(@() at(grey, 10, 'free'), 'bad_input', 'value of free is missing');
  refuses(@() at([1 NaN], 10, 'threshold', 1), 'bad_input', 'must be finite');
  refuses(@() at([1 2], 10, 'free', 'dark'), 'bad_input', 'not double');
  file = fullfile(world.folder, 'two.pgm');
  stream = fopen(file, 'w');
  fwrite(stream, ['P5 2 1 255' char([10 90 89])]);
  fclose(stream);
  assert(isequal(at(file, 10, 'threshold', 90), free));
  assert(isequal(at(file, 10, 'threshold', 90, 'free', 'dark'), flipud(free)));
  refuses(@() at(file), 'bad_input', 'give um_per_px');
  refuses(@() at(file, -1), 'bad_input', 'um_per_px is -1');
  refuses(@() at(file, 10, 'um_per_px', 10), 'bad_input', 'given twice: by um_per_px and by map.um_per_px');
  refuses(@() at(file, 10, 'um_per_unit', 10), 'bad_input', 'um_per_unit');
  refuses(@() at(file, 10, 'fre', 'dark'), 'bad_input', 'map.fre');
  length_of = @(varargin) getfield(microswarm.plan(varargin{:}, 'clearance_um', 1), 'length_um');
  dark = uint8(10 * ones(10, 10));
  for map = {dark, [uint8(60) + dark]}
    assert(abs(length_of(map{1}, [15 15], [75 15], 'um_per_px', 10, 'threshold', 100, 'free', 'dark') - 60) < 1e-9);
  end
  matrix = fullfile(world.folder, 'm.txt');
  stream = fopen(matrix, 'w');
  fprintf(stream, '0 0 0\n0 0 0\n');
  fclose(stream);
  assert(abs(length_of(matrix, [5 5], [25 5], 'um_per_px', 10, 'map.wall', 'one') - 20) < 1e-9);
  lastwarn('');
  microswarm.Map(matrix, 10, 'wall', 'one');
  assert(isempty(lastwarn()));
  microswarm.Map(matrix, 10);  % shows the warning
  [text, identifier] = lastwarn();
  assert(strcmp(identifier, 'microswarm:note') && ~isempty(strfind(text, 'map.wall=one')));
  open = microswarm.Map(true(9), 10);
  for value = {'um_per_px', 'threshold'}
    refuses(@() microswarm.plan(open, [15 15], [75 15], value{1}, 10), 'bad_input', 'is open');
  end
end

function paths_round_a_wall(world)
  path = microswarm.plan(room(), [50 50], [350 50], 'um_per_px', 10, 'clearance_um', 15);
  assert(path.solved && isempty(path.why_none) && size(path.points_um, 2) == 2);
  assert(isequal(path.points_um(1, :), [50 50]) && path.length_um > 300 && path.turning_rad > 0);
  map = microswarm.Map(room(), 10);
  tree = microswarm.plan(map, [50 50 0], [350; 50], 'planner', 'drrt_star', 'clearance_um', 15, 'seed', 2);
  again = microswarm.plan(map, [50 50 0], [350 50], 'planner', 'drrt_star', 'clearance_um', 15, 'seed', uint8(2));
  left = norm(tree.points_um(end, :) - [350 50]);  % it ends within the tolerance
  assert(tree.solved && tree.length_um + left >= path.length_um && isequal(tree.points_um, again.points_um));
  none = microswarm.plan(map, [50 50], [350 50], 'planner', 'rrt', 'clearance_um', 15, 'max_nodes', 3);
  assert(~none.solved && ~isempty(none.why_none));
  file = fullfile(world.folder, 'room.pgm');
  stream = fopen(file, 'w');
  fprintf(stream, 'P5 40 20 255\n');
  fwrite(stream, 255 * uint8(room())');
  fclose(stream);
  read = microswarm.plan(file, [50 50], [350 50], 'um_per_px', 10, 'clearance_um', 15);
  assert(read.length_um == path.length_um);
end

function bad_maps_and_paths(world)
  map = microswarm.Map(room(), 10);
  plan = @(varargin) microswarm.plan(varargin{:});
  refuses(@() microswarm.Map(), 'bad_call', 'needs a file');
  refuses(@() microswarm.Map(room()), 'bad_input', 'needs um_per_px');
  refuses(@() microswarm.Map(room(), NaN), 'bad_input', 'um_per_px');
  refuses(@() microswarm.Map(room(), [1 2]), 'bad_input', 'um_per_px');
  refuses(@() microswarm.Map(2 * double(room()), 10), 'bad_input', 'not double');
  refuses(@() microswarm.Map(uint8([2 1 0]), 10), 'bad_input', 'its largest value is 2');
  refuses(@() microswarm.Map(uint8([202 201 200]), 10, 'free', 'dark'), 'bad_input', 'its smallest value is 200');
  refuses(@() microswarm.Map(sparse(room()), 10), 'bad_input', 'not sparse');
  refuses(@() microswarm.Map({1}, 10), 'bad_input', 'not cell');
  refuses(@() microswarm.Map(true(2, 2, 2), 10), 'bad_input', 'matrix');
  refuses(@() microswarm.Map(true(0, 3), 10), 'bad_input', 'must be 1 to');
  refuses(@() microswarm.Map('none.png', 10), 'bad_input', 'none.png');
  refuses(@() map.clearance(), 'bad_call', 'clearance needs');
  refuses(@() map.clearance([1 2 3]), 'bad_input', '2 columns');
  refuses(@() map.clearance([1 NaN]), 'bad_input', 'not finite');
  refuses(@() plan(map), 'bad_call', 'needs a map, a start');
  refuses(@() plan(map, 5, [350 50]), 'bad_input', 'start must be');
  refuses(@() plan(map, [50 50], [1 2 3]), 'bad_input', 'goal must be');
  refuses(@() plan(map, [50 50], [NaN 50]), 'bad_input', 'goal');
  refuses(@() plan(map, [50 50], [200 50]), 'bad_input', 'goal');
  refuses(@() plan(map, [50 50], [350 50], 'clearence_um', 5), 'bad_input', 'did you mean');
  refuses(@() plan(map, [50 50], [350 50], 'planner', 'best'), 'bad_input', 'best');
  refuses(@() plan(map, [50 50], [350 50], 'planner', 3), 'bad_input', 'planner must be a text');
  refuses(@() plan(map, [50 50], [350 50], 'seed', -1), 'bad_input', 'seed');
  refuses(@() plan(map, [50 50], [350 50], 'seed'), 'bad_input', 'missing');
  closed = room();
  closed(:, 19:22) = false;
  refuses(@() plan(closed, [50 50], [350 50], 'um_per_px', 10, 'clearance_um', 15), 'bad_input', 'cut off');
  map.close();
  refuses(@() plan(map, [50 50], [350 50]), 'bad_call', 'closed');
end
