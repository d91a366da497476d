classdef Handle < handle
% microswarm.internal.Handle  What is open in the library until it is closed or cleared.

% SPDX-License-Identifier: Apache-2.0
  properties (SetAccess = protected, Hidden)
    id = [];  % number of the library
  end
  methods
    function close(self)
    % close()   Ends it; what is called later is an error. Closing twice is none.
      if ~isempty(self.id) && self.id ~= 0
        id = self.id;
        self.id = uint64(0);
        microswarm_mex('close', id);
      end
    end

    function delete(self)
      try  % the MEX file may be cleared already, which closed all
        self.close();
      catch
      end
    end
  end
end
