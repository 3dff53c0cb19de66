/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes of particles and springs along z, as one slice that repeats: a tube of rings, layers and
 * sectors around a line, voxels. Springs with a common stiffness form a group. */
#ifndef SW_CALIBRATE_LATTICE_H
#define SW_CALIBRATE_LATTICE_H

#include "base/param.h"
#include "calibrate/cell.h"

enum {
  SW_GROUP_LONGITUDINAL, /* along the wire */
  SW_GROUP_INNER,        /* along the wire, within the section's radius of gyration */
  SW_GROUP_CORE,         /* along the wire, at its axis */
  SW_GROUP_DIAGONAL,     /* to the next slice and round; they resist twist */
  SW_GROUP_HOOP,         /* round, within a slice */
  SW_GROUP_BRACE,        /* chords within a ring */
  SW_GROUP_SPOKE,        /* radial, within a slice */
  SW_GROUP_INCLINED,     /* radial, to the next slice */
  SW_GROUP_EDGE,         /* edges of voxels within a slice */
  SW_GROUP_CROSS,        /* diagonals within a slice */
  SW_GROUP_BEND,         /* against angles of the central line [N m] */
  SW_GROUP_SOLID,        /* elements between slices [Pa] */
  SW_GROUP_BOND,         /* between a composite's parts */
  SW_GROUP_OF_CORE,      /* from here on: the groups before bonds again, for the cores */
  SW_GROUPS = SW_GROUP_OF_CORE + SW_GROUP_BOND
};
extern const char *const sw_group_names[SW_GROUPS];

/* One slice. The stiffest links of a group have weight 1: those of the outermost layer, and those
 * with voxels on all sides. */
typedef struct sw_lattice {
  double spacing;          /* of slices [m] */
  size_t particles, links; /* in one slice [-] */
  double *at;              /* 3 numbers per particle [m] */
  double *share;           /* share of the slice's mass [-] */
  sw_cell_link *link;
  size_t capacity; /* of link [-] */
  /* Solid elements; NULL for a mesh of springs only. */
  sw_cell_solid *solid;
  size_t solids, solid_capacity; /* in one slice [-] */
} sw_lattice;

typedef struct sw_tube_args {
  long particles, reach, brace; /* [-] */
  double ring_radius;           /* [m] */
  int core, bend;               /* [-] */
} sw_tube_args;
extern const sw_params sw_tube_params;

typedef struct sw_radial_args {
  long particles, layers; /* [-] */
} sw_radial_args;
extern const sw_params sw_radial_params;

enum { SW_SECTION_CIRCLE, SW_SECTION_ANNULUS, SW_SECTION_RECTANGLE };
typedef struct sw_cubic_args {
  int section;                 /* [-] */
  long across;                 /* [-] */
  double inner, width, height; /* [m] */
  double EI2;                  /* of a rectangle, in the plane of y and z [N m2] */
} sw_cubic_args;
extern const sw_params sw_cubic_params;

/* Make *out; radial and cubic lattices include elements. Free *out with sw_lattice_free, also after
 * an error. Arguments are within their rows' limits; SW_EINVAL for values that do not go
 * together. */
sw_status sw_lattice_tube(const sw_tube_args *args, double spacing, sw_lattice *out, sw_error *err);
sw_status sw_lattice_radial(const sw_radial_args *args, double radius, double spacing,
                            sw_lattice *out, sw_error *err);
/* The radial lattice with layers at given radii: layers + 1 numbers, the first 0 [m]. */
sw_status sw_lattice_layers(size_t particles, size_t layers, const double *radius, double spacing,
                            sw_lattice *out, sw_error *err);
/* spacing NAN: the voxels are cubes. radius: of circle and annulus; the voxels' total area is that
 * of the section. */
sw_status sw_lattice_cubic(const sw_cubic_args *args, double radius, double spacing,
                           sw_lattice *out, sw_error *err);
void sw_lattice_free(sw_lattice *lattice);

/* Keep only springs; keep elements and the springs of the groups whose bits are set. */
void sw_lattice_drop_solids(sw_lattice *lattice);
void sw_lattice_keep(sw_lattice *lattice, unsigned groups);

/* Sets masses by the elements' areas; an element gives equal parts to its corners. */
void sw_lattice_share(sw_lattice *lattice);

/* Scales the section, not the spacing. */
void sw_lattice_scale(sw_lattice *lattice, double scale);

/* Returns the steps of a diagonal round the ring, given or chosen (0) [-]. */
long sw_tube_reach(const sw_tube_args *args);

sw_cell sw_lattice_cell(const sw_lattice *lattice); /* a view, valid while the lattice lives */

/* For makers of lattices: allocate particles; add a link or element; find the group of the line
 * along the wire at particle i, once all particles have place and share. The groups let EA and EI
 * have any ratio that the section allows. */
sw_status sw_lattice_room(sw_lattice *lattice, size_t particles, sw_error *err);
sw_status sw_lattice_link(sw_lattice *lattice, sw_cell_link link, sw_error *err);
/* Adds a prism on a triangle of particles, or a hexahedron on a quadrilateral (corners = 3 or 4),
 * of group SW_GROUP_SOLID, nu 0. */
sw_status sw_lattice_solid(sw_lattice *lattice, int corners, const uint32_t *corner, sw_error *err);
uint32_t sw_lattice_line(const sw_lattice *lattice, size_t i);

#endif
