% SPDX-License-Identifier: Apache-2.0
function tests = test_navigator()
% test_navigator  The navigator in a loop of one's own.
  tests = {@commands_are_those_of_the_run, @obstacles_in_every_form, @a_refused_step_changes_nothing, ...
           @robots_gather, @robots_may_be_unseen, @trials_differ, @the_example_arrives, @time_of_a_step};
end

function commands_are_those_of_the_run(world)
  settings = {'sensing.observation_delay_s', 0, 'obstacles', []};
  made = microswarm.run(world.flight, settings{:});
  frames = made.frames;
  nav = microswarm.Navigator(world.flight, settings{:});
  for k = 1:numel(frames.t_s) - 1
    swarm = [frames.x_um(k) frames.y_um(k) frames.heading_rad(k) frames.radius_um(k)];
    command = nav.step(frames.t_s(k), swarm);
    assert(command.heading_rad == frames.command_heading_rad(k));
    assert(command.speed_um_per_s == frames.command_speed_um_per_s(k));
    assert(strcmp(command.state, frames.state{k}) && command.planned == frames.planned(k));
    assert(isempty(command.target_um) || isequal(command.target_um, [frames.target_x_um(k) frames.target_y_um(k)]));
  end
  assert(k > 200 && size(nav.path(), 2) == 2);
end

function obstacles_in_every_form(world)
  swarm = [200 500 0 40];
  rows = [600 500 50; 700 300 20];
  forms = {rows, single(rows), int32(rows), uint16(rows), {rows(1, :), rows(2, :)}};
  for k = 1:numel(forms)
    nav = microswarm.Navigator(world.flight);
    command = nav.step(0, swarm, forms{k});
    if k == 1, first = command; end
    assert(isequal(command, first));
  end
  assert(isequal(command, microswarm.Navigator(world.flight).step(0, single(swarm'), rows)));
  outline = [580 450; 620 450; 620 550; 580 550];
  for obstacles = {[], zeros(0, 3), {}, {outline}, {rows(1, :), outline}}
    command = nav.step(1, swarm, obstacles{1});
    assert(isfinite(command.heading_rad));
  end
  nav.step(2, swarm, rows, [], 'numbers', [4 9], 'seen', 1.9);
  assert(strcmp(nav.step(2.1).state, 'blind') && nav.step(2.2, []).speed_um_per_s == 0);
end

function a_refused_step_changes_nothing(world)
  good = [200 500 0 40];
  rows = [600 500 50];
  bad = {{NaN, good}, 'nan'; {-1, good}, 'before'; {[], good}, 't must be one real number'; ...
         {'0', good}, 'class char'; {1i, good}, 'complex'; {{1}, good}, 'class cell'; {true, good}, 'class logical'; ...
         {[1 2], good}, '2 elements'; {1, [1 2]}, 'swarm must be 4'; {1, 'here'}, 'class char'; ...
         {1, {1, 2, 3, 4}}, 'class cell'; {1, true(1, 4)}, 'class logical'; {1, [1 2 3 4i]}, 'complex'; ...
         {1, ones(2, 2)}, 'swarm must be 4'; {1, [1 NaN 0 40]}, 'nan'; {1, [1 2 0 -4]}, '-4'; ...
         {1, sparse(good)}, 'swarm'; {1, ones(4, 1, 2)}, 'swarm'; {1, struct()}, 'class struct'; ...
         {1, good, [1 2]}, '3 columns'; {1, good, 'none'}, 'class char'; {1, good, zeros(2, 3)}, 'radius of an obstacle is 0'; ...
         {1, good, {[]}}, 'obstacle 1 is empty'; {1, good, {rows, 'a'}}, 'class char'; {1, good, {{1}}}, 'class cell'; ...
         {1, good, {[0 0; 1 0]}}, 'fewer than 3'; {1, good, {ones(2, 3)}}, 'obstacle 1 must be'; ...
         {1, good, ones(2, 3, 2)}, 'columns'; {1, good, [1 2 Inf]}, 'inf'; {1, good, sparse(rows)}, 'sparse'; ...
         {1, good, rows, [1 2]}, 'no robots'; {1, good, rows, [1 2 3]}, '2 columns'; {1, good, rows, 'two'}, 'class char'; ...
         {1, good, rows, [], 'numbers', [1 2]}, 'as many numbers'; {1, good, rows, [], 'numbers', -1}, 'must be 0 to'; ...
         {1, good, rows, [], 'numbers', 1.5}, 'must be 0 to'; {1, good, rows, [], 'numbers', {1}}, 'as many numbers'; ...
         {1, good, rows, [], 'seen', 100}, '100'; {1, good, rows, [], 'seen', 'now'}, 'seen must be'; ...
         {1, good, rows, [], 'sen', 1}, 'no option ''sen'''; {1, good, rows, [], 'seen'}, 'has no value'; ...
         {1, good, rows, [], 3}, 'must be a text'};
  nav = microswarm.Navigator(world.flight);
  other = microswarm.Navigator(world.flight);
  assert(isequal(nav.step(0, good), other.step(0, good)));
  for k = 1:size(bad, 1)
    values = bad{k, 1};
    refuses(@() nav.step(values{:}), 'bad_input', bad{k, 2});
  end
  refuses(@() nav.step(), 'bad_call', 'needs the time');
  assert(isequal(nav.step(2, good, rows), other.step(2, good, rows)));
  nav.close();
  nav.close();
  refuses(@() nav.step(3, good), 'bad_call', 'closed');
  refuses(@() nav.path(), 'bad_call', 'closed');
  refuses(@() microswarm.Navigator(), 'bad_call', 'needs a scenario');
  refuses(@() microswarm.Navigator('none.yaml'), 'bad_input', 'none.yaml');
  refuses(@() microswarm.Navigator(3), 'bad_input', 'class double');
  refuses(@() microswarm.Navigator(world.flight, 'seed'), 'bad_input', 'seed has no value');
  refuses(@() microswarm.Navigator(world.flight, 'sed', 3), 'bad_input', 'sed');
end

function robots_gather(world)
  nav = microswarm.Navigator(fullfile(world.scenarios, 'papers', 'gather', 't_junction.yaml'));
  robots = robots_of_the_junction(world);
  assert(strcmp(nav.step(0, [], [], robots).state, 'gather'));
  refuses(@() nav.step(0.1, [], [], robots(2:end, :)), 'bad_input', 'robots');
end

function robots = robots_of_the_junction(world)
  session = microswarm.Session(fullfile(world.scenarios, 'papers', 'gather', 't_junction.yaml'));
  session.step();
  count = size(session.robots(), 1);
  robots = [linspace(40, 60, count)' 2 + 6 * mod((1:count)' * 0.618, 1)];
end

function robots_may_be_unseen(world)
  nav = microswarm.Navigator(fullfile(world.scenarios, 'papers', 'gather', 't_junction.yaml'));
  robots = robots_of_the_junction(world);
  assert(strcmp(nav.step(0, [], [], robots, 'unseen', 2).state, 'gather'));
  refuses(@() nav.step(1, [], [], robots, 'unseen', size(robots, 1) + 1), 'bad_input', 'unseen');
  for bad = {-1, 0.5, NaN, 'a', {1}, 2^31}
    refuses(@() nav.step(1, [], [], robots, 'unseen', bad{1}), 'bad_input', 'unseen');
  end
  assert(strcmp(nav.step(1, [], [], robots, 'unseen', []).state, 'gather'));
end

function trials_differ(world)
  settings = {'time_limit_s', 5, 'swarm.position_noise_um', 5};
  first = microswarm.run(world.flight, settings{:});
  same = microswarm.run(world.flight, 'trial', 0, settings{:});
  other = microswarm.run(world.flight, settings{:}, 'trial', uint8(1));
  assert(strcmp(same.hash, first.hash) && ~strcmp(other.hash, first.hash));
  microswarm.Navigator(world.flight, 'seed=2', 'trial', 3);
  for bad = {-1, 0.5, NaN, 'a', {}, 2^32}
    refuses(@() microswarm.Session(world.flight, 'trial', bad{1}), 'bad_input', 'trial');
  end
  refuses(@() microswarm.Session(world.flight, 'trial'), 'bad_input', 'trial');
end

function the_example_arrives(world)
  rig = simulated_rig([200 500], 10);
  ended = camera_loop(world.flight, rig.picture, rig.time, rig.coils, 10);
  assert(strcmp(ended.state, 'arrived'));
  assert(norm(rig.place() - [1800 500]) < 60);
end

function time_of_a_step(world)
  nav = microswarm.Navigator(world.flight);
  swarm = [200 500 0 40];
  rows = [600 500 50; 1450 500 50];
  count = 500;
  times = zeros(count, 1);
  for k = 1:count
    watch = tic();
    command = nav.step(0.1 * k, swarm, rows);
    times(k) = toc(watch);
    swarm(1:2) = swarm(1:2) + 0.01 * command.speed_um_per_s * [cos(command.heading_rad) sin(command.heading_rad)];
  end
  times = sort(1e6 * times);
  fprintf('        a step of the navigator: median %.0f us, 99 %% below %.0f us, longest %.0f us\n', ...
          times(count / 2), times(round(0.99 * count)), times(end));
end
