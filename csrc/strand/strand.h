/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that are meshes of particles: a calibrated lattice along the drawn path. The wire's own
 * mesh (sw_mesh) has one node at the centre of each ring. */
#ifndef SW_STRAND_STRAND_H
#define SW_STRAND_STRAND_H

#include "calibrate/calibrate.h"
#include "state/mesh.h"
#include "state/web.h"
#include "strand/calibrated.h"

/* Particles of a wire; they define its state while the scene is not built. */
typedef struct sw_strand {
  sw_web *web;
  sw_strand_calibrated *calibrated;
  double *x, *v, *a; /* (particles x 3) [m], [m/s], [m/s2] */
  double *axial;     /* (links) forces of springs [N] */
  double *rate;      /* (links) strain rates, where dashpots know them; or NULL [1/s] */
} sw_strand;

/* The mesh to make; the wire's beam gives the other values. */
typedef struct sw_strand_plan {
  const char *name;        /* of the wire, for messages */
  const char *mesh;        /* the lattice's name */
  double spacing, squeeze; /* see sw_calibrate_args */
  int body;                /* see sw_calibrate_args */
  double wall;             /* bending stiffness of a tube's wall per length; NAN: none [N m] */
  sw_lattice_args lattice;
  sw_section section;       /* the user's values */
  sw_vec normal;            /* direction of the lattice's x; NAN = any [-] */
  int curved;               /* 1: the drawn shape is unstressed */
  double rest_twist;        /* [rad/m] */
  sw_strand_recent *recent; /* calibrations to take over and to keep; or NULL */
} sw_strand_plan;

/* SW_EINVAL if this many rings of this many particles are too many. */
sw_status sw_strand_check_count(const sw_strand_plan *plan, size_t rings, size_t per_ring,
                                sw_error *err);
/* Finds the default number of slices for a wire of this length. */
sw_status sw_strand_slices(const sw_strand_plan *plan, const sw_beam *beam, double length,
                           size_t *out, sw_error *err);
/* Orientation and strains of the sections along the nodes of a mesh. */
typedef struct sw_strand_lie {
  const double *frames;      /* (nodes x 6) tangent, direction of the lattice's x [-] */
  const double *strains;     /* (nodes x 4) strains of the beam, as in a cell [-], [1/m] */
  const unsigned char *ring; /* (nodes) 0: a particle of a line, which stretches and bends like a
                              * rod but does not twist; or NULL: all are rings */
  double spacing;            /* distance of neighbouring rings, if some nodes are no rings [m] */
} sw_strand_lie;

/* Makes a strand along the nodes of an even mesh. lie NULL: untwisted along the mesh, with sections
 * in their unloaded shape. On failure *out is not freed. */
sw_status sw_strand_new(const sw_strand_plan *plan, const sw_beam *beam, const sw_mesh *mesh,
                        const sw_strand_lie *lie, sw_strand *out, sw_error *err);
void sw_strand_free(sw_strand *strand);
/* Copies a strand; the copy shares constant data. A strand without a web gives an empty copy.
 * SW_ENOMEM. */
sw_status sw_strand_copy(const sw_strand *from, sw_strand *to);

/* Puts a strand on a tape. placed: 1 if the tape must hold the particles' positions, because
 * nothing else defines them. */
void sw_tape_strand(sw_tape *tape, sw_strand *strand, int placed);

#endif
