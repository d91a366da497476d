function text = version()
% microswarm.version  Version of the library, three numbers with points.

  % SPDX-License-Identifier: Apache-2.0
  text = microswarm_mex('version');
end
