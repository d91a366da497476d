function handle = open_source(kind, source, values)
% microswarm.internal.open_source  Opens a 'session' or 'navigator' of a file, or of YAML text of several lines.

  % SPDX-License-Identifier: Apache-2.0
  source = microswarm.internal.plain_text(source, 'the scenario');
  [values, trial] = without_trial(values);
  settings = microswarm.internal.settings_of(values);
  if any(source == char(10))
    handle = microswarm_mex([kind '_open_text'], source, settings, trial);
  else
    handle = microswarm_mex([kind '_open'], source, settings, trial);
  end
end

function [values, trial] = without_trial(values)
  trial = 0;
  k = 1;
  while k < numel(values)
    key = microswarm.internal.plain_text(values{k}, 'a key');
    if any(key == '=')
      k = k + 1;
    elseif strcmp(key, 'trial')
      trial = values{k + 1};
      values(k:k + 1) = [];
    else
      k = k + 2;
    end
  end
end
