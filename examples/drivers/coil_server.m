% SPDX-License-Identifier: Apache-2.0
% A coil driver of one's own in MATLAB, or in Octave with its package instrument-control:
% docs/reference/line-protocol.md
%
%   coil_server(5025, @(values) disp(values))        % currents in A, one per channel
%
%   driver: {type: socket, host: localhost, port: 5025}
function coil_server(port, apply)
  server = tcpserver("127.0.0.1", port);
  armed = false; fed = tic; watchdog = 0; zero = []; text = '';
  off = onCleanup(@() apply(0));                     % also after an error or Ctrl-C
  while true
    if armed && (toc(fed) > watchdog || ~server.Connected)
      armed = false;
      apply(zero);
    end
    if ~server.Connected, text = ''; end
    if server.Connected && server.NumBytesAvailable > 0
      text = [text, char(read(server, server.NumBytesAvailable, "uint8"))];
    else
      pause(0.001);
    end
    while any(text == 10)
      stop = find(text == 10, 1);
      message = strsplit(strtrim(text(1:stop)), ' ');
      text = text(stop + 1:end);
      answer = 'ok'; values = zero;
      switch message{1}
        case 'hello'
          zero = zeros(1, str2double(message{5})); values = zero;
          watchdog = str2double(message{6}) / 1000;
          armed = false;
        case 'arm'
          armed = true; fed = tic;
        case 'set'
          if armed && toc(fed) <= watchdog
            values = str2double(message(3:end)); fed = tic;
          else
            answer = 'off'; armed = false;
          end
        otherwise
          armed = false;
      end
      apply(values);
      write(server, uint8([answer, ' ', message{2}, sprintf(' %.6f', values), char(10)]));
    end
  end
end
