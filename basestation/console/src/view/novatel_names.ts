/**
 * Names of the solution status and position type that a NovAtel receiver reports as numbers
 * (OEM7 Commands and Logs Reference Manual, tables "Solution Status" and "Position or Velocity
 * Type"). A number without a name is shown as it is.
 */
// SPDX-License-Identifier: Apache-2.0
const kStatus = [
  "computed",
  "too few observations",
  "no convergence",
  "singular",
  "covariance trace",
  "test distance",
  "cold start",
  "limits exceeded",
  "variance",
  "residuals",
  "",
  "",
  "",
  "integrity warning",
  "",
  "",
  "",
  "",
  "pending",
  "invalid fix",
  "unauthorized",
  "",
  "invalid rate",
];

const kTypes: Record<number, string> = {
  0: "NONE",
  1: "FIXED POS",
  2: "FIXED HEIGHT",
  8: "DOPPLER",
  16: "SINGLE",
  17: "PSRDIFF",
  18: "WAAS",
  19: "PROPAGATED",
  32: "L1 FLOAT",
  34: "NARROW FLOAT",
  48: "L1 INT",
  49: "WIDE INT",
  50: "NARROW INT",
  52: "INS",
  53: "INS PSRSP",
  54: "INS PSRDIFF",
  55: "INS FLOAT",
  56: "INS FIXED",
  68: "PPP CONV",
  69: "PPP",
  73: "INS PPP CONV",
  74: "INS PPP",
};

export const solutionStatus = (value: number): string => kStatus[value] || String(value);
export const solutionType = (value: number): string => kTypes[value] ?? String(value);
