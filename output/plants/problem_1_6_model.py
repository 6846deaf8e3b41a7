"""The system in its control loop: its block diagram and its response to a unit step.

Needs python-control (python3 -m pip install control). With --plot it also shows the curve.
"""

import sys

import control
import numpy

# Parameters
m = 1
b = 2
k_s = 5
K_p = 1
K_i = 2
stop = 17  # the simulation ends here [s]

# Transfer functions
s = control.tf("s")
G = 1/(m*s**2 + b*s + k_s)
C = K_p + K_i/s
T = control.feedback(C * G, 1)

# Block diagram: blocks are connected where the name of an output is that of an input
blocks = [
    control.summing_junction(["r", "-x"], "e"),
    control.tf([K_p], [1], inputs="e", outputs="u_P"),
    control.tf([K_i], [1, 0], inputs="e", outputs="u_I"),
    control.summing_junction(["u_P", "u_I"], "f"),
    control.tf([1], [m, b, k_s], inputs="f", outputs="x"),
]
loop = control.interconnect(blocks, inputs=["r"], outputs=["x"])

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
    print("x does not settle; at the end it is", y[-1])
if "--plot" in sys.argv:
    import matplotlib.pyplot

    matplotlib.pyplot.plot(t, y)
    matplotlib.pyplot.xlabel("time [s]")
    matplotlib.pyplot.ylabel("x")
    matplotlib.pyplot.grid()
    matplotlib.pyplot.show()
