// Computes the rotation R that maximizes trace(R' H), as a unit quaternion (w, x, y, z). The CPU
// twin laplacian/rotation.cpp names the references.

// Horn's matrix N: q'Nq = trace(R(q)' H).
real4x4 quaternion_form(real3x3 H) {
  const real a01 = H[1][2] - H[2][1];
  const real a02 = H[2][0] - H[0][2];
  const real a03 = H[0][1] - H[1][0];
  const real a12 = H[0][1] + H[1][0];
  const real a13 = H[0][2] + H[2][0];
  const real a23 = H[1][2] + H[2][1];
  return real4x4(H[0][0] + H[1][1] + H[2][2], a01, a02, a03,
                 a01, H[0][0] - H[1][1] - H[2][2], a12, a13,
                 a02, a12, H[1][1] - H[0][0] - H[2][2], a23,
                 a03, a13, a23, H[2][2] - H[0][0] - H[1][1]);
}

// Returns the smallest rotation that maximizes trace(R' H) for a matrix H of rank 1.
real4 rotation_of_line(real3x3 H) {
  int widest = 0;
  for (int k = 1; k < 3; ++k) {
    if (dot(H[k], H[k]) > dot(H[widest], H[widest])) widest = k;
  }
  const real3 to = normalize(H[widest]);
  const real3 from = normalize(real3(dot(H[0], to), dot(H[1], to), dot(H[2], to)));
  const real4 q = real4(1 + dot(from, to), cross(from, to));
  if (dot(q, q) > kRankOneShare) return normalize(q);
  // Half a turn about an axis perpendicular to the line.
  const real3 other = abs(from.x) < real(0.5) ? real3(1, 0, 0) : real3(0, 1, 0);
  return real4(real(0), normalize(cross(from, other)));
}

// Returns the eigenvector of the largest eigenvalue by Jacobi rotations. This is slow, but accurate
// even if two eigenvalues are close.
real4 rotation_by_jacobi(real4x4 N) {
  const int kSweeps = 8;
  real4x4 V = real4x4(1);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int p = 0; p < 3; ++p) {
      for (int r = p + 1; r < 4; ++r) {
        if (N[p][r] == 0) continue;
        const real theta = (N[r][r] - N[p][p]) / (2 * N[p][r]);
        const real t = (theta < 0 ? real(-1) : real(1)) / (abs(theta) + sqrt(theta * theta + 1));
        const real c = 1 / sqrt(t * t + 1);
        const real s = t * c;
        for (int k = 0; k < 4; ++k) {
          const real a = N[p][k];
          const real b = N[r][k];
          N[p][k] = c * a - s * b;
          N[r][k] = s * a + c * b;
        }
        for (int k = 0; k < 4; ++k) {
          const real a = N[k][p];
          const real b = N[k][r];
          N[k][p] = c * a - s * b;
          N[k][r] = s * a + c * b;
        }
        const real4 v = V[p];
        V[p] = c * v - s * V[r];
        V[r] = s * v + c * V[r];
      }
    }
  }
  int best = 0;
  for (int k = 1; k < 4; ++k) {
    if (N[k][k] > N[best][best]) best = k;
  }
  return normalize(V[best]);
}

real determinant_of(real4x4 A, int row, int column) {
  int r[3];
  int c[3];
  for (int k = 0; k < 3; ++k) {
    r[k] = k < row ? k : k + 1;
    c[k] = k < column ? k : k + 1;
  }
  return A[c[0]][r[0]] * (A[c[1]][r[1]] * A[c[2]][r[2]] - A[c[2]][r[1]] * A[c[1]][r[2]]) -
         A[c[1]][r[0]] * (A[c[0]][r[1]] * A[c[2]][r[2]] - A[c[2]][r[1]] * A[c[0]][r[2]]) +
         A[c[2]][r[0]] * (A[c[0]][r[1]] * A[c[1]][r[2]] - A[c[1]][r[1]] * A[c[0]][r[2]]);
}

real4 nearest_rotation(real3x3 given) {
  const real4 identity = real4(1, 0, 0, 0);
  // Scaled twice, because the squares may underflow for a small mesh.
  const real3 largest_of_rows = max(max(abs(given[0]), abs(given[1])), abs(given[2]));
  const real largest_entry = max(max(largest_of_rows.x, largest_of_rows.y), largest_of_rows.z);
  if (!(largest_entry > 0) || isinf(float(largest_entry))) return identity;
  const real3x3 scaled = given / largest_entry;
  const real3x3 H = scaled / sqrt(dot(scaled[0], scaled[0]) + dot(scaled[1], scaled[1]) +
                                  dot(scaled[2], scaled[2]));
  const real3 u = cross(H[1], H[2]);
  const real3 v = cross(H[2], H[0]);
  const real3 w = cross(H[0], H[1]);
  const real cofactors = dot(u, u) + dot(v, v) + dot(w, w);
  if (cofactors <= kRankOneShare * kRankOneShare) return rotation_of_line(H);

  // Newton's method descends to the largest root of the characteristic polynomial. kMostSteps
  // equals kMostNewtonSteps in laplacian/rotation.cpp. If two roots are close, as for an almost
  // collinear ring, every step halves the distance, and 20 steps reach kSmallestGap.
  const int kMostSteps = 40;
  const real b = -8 * dot(H[0], u);
  const real c = 1 - 4 * cofactors;
  real l = sqrt(real(3));
  real down = real(1);
  for (int step = 0; step < kMostSteps && down > kConverged; ++step) {
    const real slope = (4 * l * l - 4) * l + b;
    if (!(slope > kSmallestGap)) break;
    down = (((l * l - 2) * l + b) * l + c) / slope;
    l -= down;
  }
  const real4x4 N = quaternion_form(H);
  if (!((4 * l * l - 4) * l + b > kSmallestGap)) return rotation_by_jacobi(N);
  // The adjugate of N - l I is a multiple of q q', so its column with the largest diagonal entry is
  // a multiple of q.
  const real4x4 A = N - l * real4x4(1);
  int best = 0;
  real largest = real(0);
  for (int k = 0; k < 4; ++k) {
    const real diagonal = abs(determinant_of(A, k, k));
    if (diagonal > largest) {
      largest = diagonal;
      best = k;
    }
  }
  real4 q;
  for (int k = 0; k < 4; ++k) {
    const real minor = determinant_of(A, k, best);
    q[k] = ((k + best) & 1) == 0 ? minor : -minor;
  }
  return normalize(q);
}

// Returns |q|^2 R(q) v for a quaternion of any length.
real3 turn(real4 q, real3 v) {
  return (q.x * q.x - dot(q.yzw, q.yzw)) * v + 2 * dot(q.yzw, v) * q.yzw + 2 * q.x * cross(q.yzw, v);
}

// Returns turn(q, v) - v without cancellation errors.
real3 turn_change(real4 q, real3 v) {
  return (q.x * q.x - dot(q.yzw, q.yzw) - 1) * v + 2 * dot(q.yzw, v) * q.yzw +
         2 * q.x * cross(q.yzw, v);
}
