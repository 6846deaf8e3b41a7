% The motor in its control loop: block diagram in Simulink and response to a unit step.

%% Parameters
J = 2;
K_m = 1;
R_a = 1;
L_a = 1;
b = 0.5;
K_b = 1;
K_p = 1;
K_d = 1.5;
tau_f = 0.005;  % filter of the derivative [s]
stop = 14;  % the simulation ends here [s]

%% Transfer functions
s = tf('s');
G = K_m/((J*s^2 + b*s)*(L_a*s + R_a) + K_m*K_b*s);
C = K_p + K_d*s/(tau_f*s + 1);
T = minreal(feedback(C*G, 1));
[y, t] = step(T, stop);

%% Block diagram
model = 'motor_model';
if bdIsLoaded(model)
    close_system(model, 0);
end
new_system(model);
open_system(model);
add_block('simulink/Sources/Step', [model '/r'], 'Time', '0', 'After', '1');
add_block('simulink/Math Operations/Sum', [model '/e'], 'Inputs', '+-');
add_block('simulink/Math Operations/Gain', [model '/u_P'], 'Gain', 'K_p');
add_block('simulink/Continuous/Transfer Fcn', [model '/u_D'], ...
    'Numerator', '[K_d, 0]', 'Denominator', '[tau_f, 1]');
add_block('simulink/Math Operations/Sum', [model '/V_a'], 'Inputs', '++');
add_block('simulink/Sources/Step', [model '/T_d'], 'Time', '0', 'After', '0');
add_block('simulink/Math Operations/Gain', [model '/T_m'], 'Gain', 'K_m');
add_block('simulink/Math Operations/Sum', [model '/sum_I_a'], 'Inputs', '+-');
add_block('simulink/Continuous/Transfer Fcn', [model '/I_a'], ...
    'Numerator', '[1]', 'Denominator', '[L_a, R_a]');
add_block('simulink/Math Operations/Gain', [model '/V_b'], 'Gain', 'K_b');
add_block('simulink/Math Operations/Sum', [model '/T_L'], 'Inputs', '+-');
add_block('simulink/Continuous/Transfer Fcn', [model '/theta_dot'], ...
    'Numerator', '[1]', 'Denominator', '[J, b]');
add_block('simulink/Continuous/Integrator', [model '/theta']);
add_block('simulink/Sinks/Scope', [model '/scope']);
add_block('simulink/Sinks/To Workspace', [model '/record'], 'VariableName', 'response', ...
    'SaveFormat', 'Timeseries');
add_line(model, 'r/1', 'e/1', 'autorouting', 'on');
add_line(model, 'theta/1', 'e/2', 'autorouting', 'on');
add_line(model, 'e/1', 'u_P/1', 'autorouting', 'on');
add_line(model, 'e/1', 'u_D/1', 'autorouting', 'on');
add_line(model, 'u_P/1', 'V_a/1', 'autorouting', 'on');
add_line(model, 'u_D/1', 'V_a/2', 'autorouting', 'on');
add_line(model, 'I_a/1', 'T_m/1', 'autorouting', 'on');
add_line(model, 'V_a/1', 'sum_I_a/1', 'autorouting', 'on');
add_line(model, 'V_b/1', 'sum_I_a/2', 'autorouting', 'on');
add_line(model, 'sum_I_a/1', 'I_a/1', 'autorouting', 'on');
add_line(model, 'theta_dot/1', 'V_b/1', 'autorouting', 'on');
add_line(model, 'T_m/1', 'T_L/1', 'autorouting', 'on');
add_line(model, 'T_d/1', 'T_L/2', 'autorouting', 'on');
add_line(model, 'T_L/1', 'theta_dot/1', 'autorouting', 'on');
add_line(model, 'theta_dot/1', 'theta/1', 'autorouting', 'on');
add_line(model, 'theta/1', 'scope/1', 'autorouting', 'on');
add_line(model, 'theta/1', 'record/1', 'autorouting', 'on');
Simulink.BlockDiagram.arrangeSystem(model);

%% Simulation
out = sim(model, 'StopTime', num2str(stop), 'RelTol', '1e-6', ...
    'MaxStep', num2str(stop/1000));
response = out.get('response');
plot(response.Time, squeeze(response.Data), t, y, '--');
grid on;
xlabel('time [s]');
ylabel('theta', 'Interpreter', 'none');
legend('block diagram', 'transfer function');
