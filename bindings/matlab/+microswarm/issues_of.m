function issues = issues_of(problem)
% issues = microswarm.issues_of(problem)   The mistakes behind an error that was caught, a column of structs.
%
%   try
%     microswarm.run('first_flight.yaml', 'swarm.radius_um', -1, 'seed', 'a');
%   catch problem
%     for issue = microswarm.issues_of(problem)'
%       fprintf('%s is %s, allowed: %s\n', issue.key, issue.value, issue.limit);
%     end
%   end
%
% key     of the value, from the top of the scenario: 'obstacles.3.shape.radius_um'
% place   where it was given: 'flight.yaml:12:3', 'map.png', or the key of a setting
% text    what is wrong
% value   as written
% limit   what is allowed: '1..1e5 um', or words
%
% What is unknown is ''. Of an error that is not the last one of this package there is only the text.

  % SPDX-License-Identifier: Apache-2.0
  issues = microswarm_mex('issues', problem.message);
end
