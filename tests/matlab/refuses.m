% SPDX-License-Identifier: Apache-2.0
function refuses(call, code, words)
% refuses(call, code, words)  Asserts that a call ends in the error microswarm:CODE whose text has the words.
  try
    call();
  catch problem
    assert(strcmp(problem.identifier, ['microswarm:' code]), ...
           sprintf('%s: is %s: %s', func2str(call), problem.identifier, problem.message));
    assert(isempty(words) || ~isempty(strfind(problem.message, words)), ...
           sprintf('%s: ''%s'' is not in: %s', func2str(call), words, problem.message));
    return
  end
  error('%s: was not refused', func2str(call));
end
