function handle = open_source(kind, source, values)
% microswarm.internal.open_source  Opens a 'session' or 'navigator' of a file, or of YAML text of several lines.

  % SPDX-License-Identifier: Apache-2.0
  source = microswarm.internal.plain_text(source, 'the scenario');
  settings = microswarm.internal.settings_of(values);
  if any(source == char(10))
    handle = microswarm_mex([kind '_open_text'], source, settings);
  else
    handle = microswarm_mex([kind '_open'], source, settings);
  end
end
