% The system in its control loop: block diagram in Simulink and response to a unit step.

%% Parameters
m = 1;
b = 2;
k_s = 5;
K_p = 1;
K_i = 2;
stop = 17;  % the simulation ends here [s]

%% Transfer functions
s = tf('s');
G = 1/(m*s^2 + b*s + k_s);
C = K_p + K_i/s;
T = minreal(feedback(C*G, 1));
[y, t] = step(T, stop);

%% Block diagram
model = 'system_model';
if bdIsLoaded(model)
    close_system(model, 0);
end
new_system(model);
open_system(model);
add_block('simulink/Sources/Step', [model '/r'], 'Time', '0', 'After', '1');
add_block('simulink/Math Operations/Sum', [model '/e'], 'Inputs', '+-');
add_block('simulink/Math Operations/Gain', [model '/u_P'], 'Gain', 'K_p');
add_block('simulink/Continuous/Transfer Fcn', [model '/u_I'], ...
    'Numerator', '[K_i]', 'Denominator', '[1, 0]');
add_block('simulink/Math Operations/Sum', [model '/f'], 'Inputs', '++');
add_block('simulink/Continuous/Transfer Fcn', [model '/x'], ...
    'Numerator', '[1]', 'Denominator', '[m, b, k_s]');
add_block('simulink/Sinks/Scope', [model '/scope']);
add_block('simulink/Sinks/To Workspace', [model '/record'], 'VariableName', 'response', ...
    'SaveFormat', 'Timeseries');
add_line(model, 'r/1', 'e/1', 'autorouting', 'on');
add_line(model, 'x/1', 'e/2', 'autorouting', 'on');
add_line(model, 'e/1', 'u_P/1', 'autorouting', 'on');
add_line(model, 'e/1', 'u_I/1', 'autorouting', 'on');
add_line(model, 'u_P/1', 'f/1', 'autorouting', 'on');
add_line(model, 'u_I/1', 'f/2', 'autorouting', 'on');
add_line(model, 'f/1', 'x/1', 'autorouting', 'on');
add_line(model, 'x/1', 'scope/1', 'autorouting', 'on');
add_line(model, 'x/1', 'record/1', 'autorouting', 'on');
Simulink.BlockDiagram.arrangeSystem(model);

%% Simulation
out = sim(model, 'StopTime', num2str(stop), 'RelTol', '1e-6', ...
    'MaxStep', num2str(stop/1000));
response = out.get('response');
plot(response.Time, squeeze(response.Data), t, y, '--');
grid on;
xlabel('time [s]');
ylabel('x', 'Interpreter', 'none');
legend('block diagram', 'transfer function');
