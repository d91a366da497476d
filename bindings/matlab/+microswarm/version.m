function text = version()
% microswarm.version  Version of the library, for example '0.1.0'.

  % SPDX-License-Identifier: Apache-2.0
  text = microswarm_mex('version');
end
