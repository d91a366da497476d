function settings = settings_of(values, prefix)
% microswarm.internal.settings_of  Texts 'KEY=VALUE' from arguments 'KEY=VALUE' and pairs 'KEY', value.
%
% `prefix` stands before the key of each pair.

  % SPDX-License-Identifier: Apache-2.0
  if nargin < 2, prefix = ''; end
  settings = {};
  k = 1;
  while k <= numel(values)
    key = microswarm.internal.plain_text(values{k}, 'a key');
    if any(key == '=')
      settings{end + 1} = [prefix key];  %#ok<AGROW>
      k = k + 1;
    elseif k == numel(values)
      error('microswarm:bad_input', 'the key %s has no value', key);
    else
      settings{end + 1} = [prefix key '=' microswarm.internal.value_text(values{k + 1}, key)];  %#ok<AGROW>
      k = k + 2;
    end
  end
end
