"""The motor in its control loop: its block diagram and its response to a unit step.

Needs python-control (python3 -m pip install control). With --plot it also shows the curve.
"""

import sys

import control
import numpy

# Parameters
J = 2
K_m = 1
R_a = 1
L_a = 1
b = 0.5
K_b = 1
K_p = 1
K_d = 1.5
tau_f = 0.005  # filter of the derivative [s]
stop = 14  # the simulation ends here [s]

# Transfer functions
s = control.tf("s")
G = K_m/((J*s**2 + b*s)*(L_a*s + R_a) + K_m*K_b*s)
C = K_p + K_d*s/(tau_f*s + 1)
T = control.feedback(C * G, 1)

# Block diagram: blocks are connected where the name of an output is that of an input
blocks = [
    control.summing_junction(["r", "-theta"], "e"),
    control.tf([K_p], [1], inputs="e", outputs="u_P"),
    control.tf([K_d, 0], [tau_f, 1], inputs="e", outputs="u_D"),
    control.summing_junction(["u_P", "u_D"], "V_a"),
    control.tf([K_m], [1], inputs="I_a", outputs="T_m"),
    control.summing_junction(["V_a", "-V_b"], "sum_I_a"),
    control.tf([1], [L_a, R_a], inputs="sum_I_a", outputs="I_a"),
    control.tf([K_b], [1], inputs="theta_dot", outputs="V_b"),
    control.summing_junction(["T_m", "-T_d"], "T_L"),
    control.tf([1], [J, b], inputs="T_L", outputs="theta_dot"),
    control.tf([1], [1, 0], inputs="theta_dot", outputs="theta"),
]
loop = control.interconnect(blocks, inputs=["r", "T_d"], outputs=["theta"])

# Simulation
t = numpy.linspace(0, stop, 5001)
response = control.step_response(loop, t, input=0, squeeze=True)
other = control.step_response(T, t, squeeze=True)
y = response.outputs
print("largest difference from T(s):", numpy.max(numpy.abs(y - other.outputs)))
if numpy.all(T.poles().real < 0):
    for name, number in control.step_info(y, t, yfinal=T.dcgain()).items():
        print(f"{name}: {number:.6g}")
else:
    print("theta does not settle; at the end it is", y[-1])
if "--plot" in sys.argv:
    import matplotlib.pyplot

    matplotlib.pyplot.plot(t, y)
    matplotlib.pyplot.xlabel("time [s]")
    matplotlib.pyplot.ylabel("theta")
    matplotlib.pyplot.grid()
    matplotlib.pyplot.show()
