% SPDX-License-Identifier: Apache-2.0
function tests = test_runs()
% test_runs  Runs, sessions and records.
  tests = {@a_run_is_that_of_the_program, @settings_in_every_form, @a_scenario_from_text, ...
           @a_session_step_by_step, @a_record_is_the_run, ...
           @frames_have_what_a_record_has, @robots_are_shown, @a_run_among_many, @mistakes_are_fields};
end

function a_run_is_that_of_the_program(world)
  for name = {'first_flight', 'oncoming'}
    file = fullfile(world.scenarios, [name{1} '.yaml']);
    [code, said] = system(sprintf('"%s" run "%s" --json --out "%s" 2>/dev/null', world.program, file, ...
                                  fullfile(world.folder, name{1})));
    assert(code == 0);
    told = jsondecode(said);
    result = microswarm.run(file);
    assert(strcmp(result.hash, told.record_hash));
    assert(strcmp(result.status, told.status));
    assert(result.metrics.length_um == told.metrics.length_um);
    fprintf('        %s: record hash %s\n', name{1}, result.hash);
  end
end

function problem = problem_of(call)
  problem = [];
  try
    call();
  catch problem
  end
  assert(~isempty(problem), func2str(call));
end

function mistakes_are_fields(world)
  problem = problem_of(@() microswarm.run(world.flight, 'tick_s', 0, 'navigator.sped_um_per_s', 3));
  assert(isempty(strfind(problem.message, '--set')), problem.message);
  issues = microswarm.issues_of(problem);
  assert(isequal(size(issues), [2 1]));
  assert(strcmp(issues(1).key, 'tick_s') && strcmp(issues(1).place, 'tick_s'));
  assert(strcmp(issues(1).value, '0') && strcmp(issues(1).limit, '0.001..10 s'));
  assert(~isempty(strfind(issues(1).text, 'tick_s is 0 s')));
  assert(strcmp(issues(2).key, 'navigator.sped_um_per_s') && strcmp(issues(2).value, '3'));
  session = microswarm.Session(world.flight);
  issues = microswarm.issues_of(problem_of(@() session.set('goal_um', 'x')));
  assert(isscalar(issues) && strcmp(issues.key, 'goal_um') && strcmp(issues.value, 'x'));
  assert(strcmp(issues.limit, '[x, y]') && isempty(issues.place));
  % Of an older error, or of one that is not the library's, there is the text.
  issues = microswarm.issues_of(problem);
  assert(isscalar(issues) && strcmp(issues.text, problem.message) && isempty(issues.key));
  problem = problem_of(@() session.advance('a'));
  issues = microswarm.issues_of(problem);
  assert(isscalar(issues) && strcmp(issues.text, problem.message));
end

function settings_in_every_form(world)
  plain = microswarm.run(world.flight, 'seed=4', 'goal_um=[1700, 300]');
  pairs = microswarm.run(world.flight, 'seed', 4, 'goal_um', [1700 300]);
  other = microswarm.run(world.flight, 'seed', int32(4), 'goal_um', single([1700; 300]));
  assert(isequal(plain.hash, pairs.hash, other.hash));
  first = microswarm.run(world.flight);
  assert(~strcmp(plain.hash, first.hash));
  text = @microswarm.internal.value_text;
  assert(strcmp(text(0.1, ''), '0.10000000000000001') && strcmp(text(true, ''), 'true'));
  assert(strcmp(text([], ''), '[]') && strcmp(text({[0 0; 1 2], 'disc'}, ''), '[[[0, 0], [1, 2]], disc]'));
end

function a_scenario_from_text(world)
  of_text = microswarm.run(fileread(world.flight));
  of_file = microswarm.run(world.flight);
  assert(strcmp(of_text.hash, of_file.hash));
end

function a_session_step_by_step(world)
  session = microswarm.Session(world.flight);
  assert(strcmp(session.status(), 'running') && isempty(session.robots()));
  first = session.step();
  assert(first.t_s == 0 && first.x_um == 200 && first.y_um == 500 && ischar(first.state));
  assert(islogical(first.planned) && isequal(size(session.obstacles()), [2 3]));
  assert(size(session.path(), 2) == 2 && size(session.path(), 1) >= 2);
  session.set('navigator.speed_um_per_s', 60);
  refuses(@() session.set('navigator.sped_um_per_s', 60), 'bad_input', 'did you mean');
  refuses(@() session.set('navigator.speed_um_per_s', NaN), 'bad_input', 'finite');
  assert(~session.advance(10));
  assert(numel(session.frames().t_s) == 11);
  while ~isempty(session.step()), end
  assert(session.advance(1) && isempty(session.step()));
  result = session.result();
  assert(strcmp(result.status, 'solved') && iscolumn(result.frames.x_um));
  assert(strcmp(result.frames.state{end}, 'end') && isstruct(result.metrics.walls));
  session.close();
  session.close();
end

function a_record_is_the_run(world)
  file = fullfile(world.folder, 'record.h5');
  session = microswarm.Session(world.flight, 'seed', 5);
  while ~session.advance(100), end
  session.save(file);
  made = session.result();
  read = microswarm.read_record(file);
  assert(isequal(read.status, made.status) && isequal(read.hash, made.hash));
  assert(isequal(fieldnames(read.frames), fieldnames(made.frames)));
  names = fieldnames(read.frames);
  for k = 1:numel(names)
    a = read.frames.(names{k});
    b = made.frames.(names{k});
    assert(isequal(a, b) || (isnumeric(a) && isequal(isnan(a), isnan(b)) && isequal(a(~isnan(a)), b(~isnan(b)))));
  end
  assert(isequal(read.metrics, made.metrics));
  refuses(@() microswarm.read_record(world.flight), 'bad_input', 'is no record');
  refuses(@() microswarm.read_record('none.h5'), 'bad_input', 'none.h5');
end

function frames_have_what_a_record_has(world)
  file = fullfile(world.folder, 'columns.h5');
  session = microswarm.Session(world.flight);
  first = session.step();
  while ~session.advance(100), end
  session.save(file);
  record = load('-hdf5', file, 'frames');
  made = session.frames();
  names = fieldnames(made);
  assert(isequal(sort(names), sort(fieldnames(record.frames))));
  for k = 1:numel(names)
    a = made.(names{k});
    b = double(record.frames.(names{k})(:));
    if iscell(a)
      assert(strcmp(first.(names{k}), a{1}) && numel(unique(a)) == numel(unique(b)));
    else
      assert(isequaln(double(a), b) && isequaln(first.(names{k}), a(1)), names{k});
    end
  end
end

function robots_are_shown(world)
  session = microswarm.Session(fullfile(world.scenarios, 'papers', 'gather', 't_junction.yaml'));
  frame = session.step();
  places = session.robots();
  assert(size(places, 2) == 2 && size(places, 1) > 1 && frame.radius_um == 0);
end

function a_run_among_many(world)
  sessions = {};
  for k = 1:50
    sessions{k} = microswarm.Session(world.flight);  %#ok<AGROW>
  end
  for k = 1:2:50, sessions{k}.close(); end
  assert(sessions{2}.step().t_s == 0);
  refuses(@() sessions{1}.step(), 'bad_call', 'closed');
end
