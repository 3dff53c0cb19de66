/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Voxels of a section: particles at their corners, springs along edges and face diagonals. A
 * spring's weight is the share of its voxels that exist: quarters along edges, halves on faces. If
 * all have the stiffness k = 0.4 E a, the body is isotropic with nu = 1/4. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "calibrate/lattice.h"

enum { MOST_ACROSS = 16, MOST = 4 * MOST_ACROSS }; /* voxels in one direction [-] */

static const char *const sections[] = {"circle", "annulus", "rectangle", NULL};

#define AT(member) offsetof(sw_cubic_args, member)
#define LENGTH(name, doc) \
  { #name, SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(name), doc }
static const sw_param rows[] = {
    {"section", SW_PARAM_CHOICE, "-", SW_SECTION_CIRCLE, 0, 0, 0, sections, AT(section),
     "shape of the section"},
    {"across", SW_PARAM_INTEGER, "-", 4, 1, MOST_ACROSS, 0, NULL, AT(across),
     "voxels across the diameter or the width"},
    LENGTH(inner, "inner radius of an annulus"),
    LENGTH(width, "of a rectangle, along x"),
    LENGTH(height, "of a rectangle, along y"),
    {"EI2", SW_PARAM_NUMBER, "N m2", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(EI2),
     "of a rectangle: bending stiffness in the plane of y and z; EI is for the plane of x and z"},
};
const sw_params sw_cubic_params = SW_PARAMS("calibrate", rows);

typedef struct grid {
  size_t nx, ny;                          /* voxels [-] */
  double ax, ay;                          /* their size [m] */
  unsigned char full[MOST + 2][MOST + 2]; /* with an empty margin: voxel i, j at [i + 1][j + 1] */
  int32_t particle[MOST + 1][MOST + 1];   /* at the corner of voxels i - 1, i; -1: none */
} grid;

static sw_status rectangle(const sw_cubic_args *a, grid *g, sw_error *err) {
  if (isnan(a->width) || isnan(a->height))
    return sw_fail(err, SW_EINVAL, "calibrate: section = 'rectangle' needs width and height [m]");
  g->nx = (size_t)a->across;
  g->ax = a->width / (double)g->nx;
  const double rows_of = fmax(1, round(a->height / g->ax));
  if (rows_of > MOST)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: height = %g m is %.0f voxels of %g m high; at most %d: reduce "
                   "across",
                   a->height, rows_of, g->ax, MOST);
  g->ny = (size_t)rows_of;
  g->ay = a->height / rows_of;
  for (size_t i = 0; i < g->nx; i++)
    for (size_t j = 0; j < g->ny; j++) g->full[i + 1][j + 1] = 1;
  return SW_OK;
}

/* Fills the voxels whose centre is inside; their size makes the total area right. */
static sw_status circle(const sw_cubic_args *a, double radius, grid *g, sw_error *err) {
  const double inner = a->section == SW_SECTION_ANNULUS ? a->inner : 0;
  double count = 0;
  if (!(inner < radius))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: section = 'annulus' needs inner [m], below radius = %g m", radius);
  g->nx = g->ny = (size_t)a->across;
  const double pitch = 2 * radius / (double)a->across;
  for (size_t i = 0; i < g->nx; i++)
    for (size_t j = 0; j < g->ny; j++) {
      const double x = ((double)i + 0.5) * pitch - radius, y = ((double)j + 0.5) * pitch - radius;
      const double r = hypot(x, y);
      g->full[i + 1][j + 1] = r <= radius * (1 + 1e-9) && r >= inner * (1 - 1e-9);
      count += g->full[i + 1][j + 1];
    }
  if (count == 0)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: no voxel of %g m lies between inner = %g m and radius = %g m; "
                   "increase across = %ld",
                   pitch, inner, radius, a->across);
  g->ax = g->ay = sqrt(M_PI * (radius * radius - inner * inner) / count);
  return SW_OK;
}

/* Returns the number of voxels at the corner i, j. */
static int around(const grid *g, size_t i, size_t j) {
  return g->full[i][j] + g->full[i + 1][j] + g->full[i][j + 1] + g->full[i + 1][j + 1];
}

static sw_status place_corners(grid *g, sw_lattice *l, sw_error *err) {
  size_t particles = 0, voxels = 0;
  for (size_t i = 0; i <= g->nx; i++)
    for (size_t j = 0; j <= g->ny; j++) {
      const int count = around(g, i, j);
      g->particle[i][j] = count ? (int32_t)particles++ : -1;
      voxels += (size_t)count;
    }
  SW_TRY(sw_lattice_room(l, particles, err));
  for (size_t i = 0; i <= g->nx; i++)
    for (size_t j = 0; j <= g->ny; j++) {
      if (g->particle[i][j] < 0) continue;
      const size_t p = (size_t)g->particle[i][j];
      sw_store(l->at + 3 * p, sw_v(((double)i - 0.5 * (double)g->nx) * g->ax,
                                   ((double)j - 0.5 * (double)g->ny) * g->ay, 0));
      l->share[p] = around(g, i, j) / (double)voxels;
    }
  return SW_OK;
}

/* Adds the links on an edge from p to q, which `count` voxels share: the edge, and the diagonals of
 * the face that stands on it. */
static sw_status edge(sw_lattice *l, int32_t p, int32_t q, int count, sw_error *err) {
  if (!count) return SW_OK;
  const uint32_t a = (uint32_t)p, b = (uint32_t)q;
  const double weight = 0.5 * count;
  SW_TRY(sw_lattice_link(l, (sw_cell_link){a, b, SW_GROUP_EDGE, 0, 0, weight}, err));
  SW_TRY(sw_lattice_link(l, (sw_cell_link){a, b, SW_GROUP_DIAGONAL, 1, 0, weight}, err));
  return sw_lattice_link(l, (sw_cell_link){b, a, SW_GROUP_DIAGONAL, 1, 0, weight}, err);
}

/* Adds the links and the element of the corner i, j and of the voxel, edges and faces that begin
 * there. */
static sw_status corner(const grid *g, sw_lattice *l, size_t i, size_t j, sw_error *err) {
  const int32_t p = g->particle[i][j];
  const uint32_t a = (uint32_t)p;
  const uint32_t along = sw_lattice_line(l, a);
  SW_TRY(sw_lattice_link(l, (sw_cell_link){a, a, along, 1, 0, 0.25 * around(g, i, j)}, err));
  if (i < g->nx)
    SW_TRY(edge(l, p, g->particle[i + 1][j], g->full[i + 1][j] + g->full[i + 1][j + 1], err));
  if (j < g->ny)
    SW_TRY(edge(l, p, g->particle[i][j + 1], g->full[i][j + 1] + g->full[i + 1][j + 1], err));
  if (!g->full[i + 1][j + 1]) return SW_OK;
  const uint32_t b = (uint32_t)g->particle[i + 1][j], c = (uint32_t)g->particle[i][j + 1];
  const uint32_t d = (uint32_t)g->particle[i + 1][j + 1];
  SW_TRY(sw_lattice_link(l, (sw_cell_link){a, d, SW_GROUP_CROSS, 0, 0, 1}, err));
  SW_TRY(sw_lattice_solid(l, 4, (uint32_t[]){a, b, d, c}, err));
  return sw_lattice_link(l, (sw_cell_link){b, c, SW_GROUP_CROSS, 0, 0, 1}, err);
}

sw_status sw_lattice_cubic(const sw_cubic_args *a, double radius, double spacing, sw_lattice *l,
                           sw_error *err) {
  grid g;
  *l = (sw_lattice){0};
  memset(&g, 0, sizeof g);
  SW_TRY(a->section == SW_SECTION_RECTANGLE ? rectangle(a, &g, err) : circle(a, radius, &g, err));
  SW_TRY(place_corners(&g, l, err));
  l->spacing = isnan(spacing) ? g.ax : spacing;
  for (size_t i = 0; i <= g.nx; i++)
    for (size_t j = 0; j <= g.ny; j++)
      if (g.particle[i][j] >= 0) SW_TRY(corner(&g, l, i, j, err));
  return SW_OK;
}
