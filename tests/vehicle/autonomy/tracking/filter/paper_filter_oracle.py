# The Kalman filter of AB3DMOT in NumPy, for one car and both kinds of measurement.
#   in   argv[1]: a line of r, start variance, start speed variance, q, speed q, frame time; then
#        per line dt, number of values, values. The first line begins the track
#   out  argv[2]: per line the 7 states and the diagonal of P
import sys

import numpy as np

lines = [[float(v) for v in line.split()] for line in open(sys.argv[1])]
r, start, start_speed, q, speed_q, frame_s = lines[0]
x = np.zeros(7)
x[:5] = lines[1][2:]
P = np.diag([start] * 5 + [start_speed] * 2)
with open(sys.argv[2], "w") as out:
    for line in lines[2:]:
        dt, n = line[0], int(line[1])
        F = np.eye(7)
        F[0, 5] = F[1, 6] = dt
        x = F @ x
        P = F @ P @ F.T + dt / frame_s * np.diag([q] * 5 + [speed_q] * 2)
        H = np.eye(7)[:n]
        residual = np.array(line[2:]) - H @ x
        if n == 5:
            while abs(residual[2]) > np.pi / 2:  # a box may be turned around
                residual[2] -= np.copysign(np.pi, residual[2])
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + r * np.eye(n))
        x = x + K @ residual
        P = (np.eye(7) - K @ H) @ P
        out.write(" ".join(repr(float(v)) for v in [*x, *np.diag(P)]) + "\n")
