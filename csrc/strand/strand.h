/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires that are meshes of particles: a calibrated lattice along the drawn path. The wire's own
 * mesh (sw_mesh) then has one node for each ring, in its middle. */
#ifndef SW_STRAND_STRAND_H
#define SW_STRAND_STRAND_H

#include "calibrate/calibrate.h"
#include "state/mesh.h"
#include "state/web.h"

/* The calibration of a mesh, shared by all strands that have its web. */
typedef struct sw_strand_calibrated {
  int references;
  sw_calibration calibration;
} sw_strand_calibrated;

/* Particles of a wire; authoritative while the scene is not built. */
typedef struct sw_strand {
  sw_web *web;
  sw_strand_calibrated *calibrated;
  double *x, *v, *a; /* (particles x 3) [m], [m/s], [m/s2] */
  double *axial;     /* (links) of springs [N] */
  double *rate;      /* (links) of their strains, where dashpots know it; or NULL [1/s] */
} sw_strand;

/* The mesh to be made; the wire's beam gives the rest. */
typedef struct sw_strand_plan {
  const char *name;        /* of the wire, for messages */
  const char *mesh;        /* the lattice's name */
  double spacing, squeeze; /* see sw_calibrate_args */
  int body;                /* likewise */
  double wall;             /* bending stiffness of a tube's wall per length; NAN: none [N m] */
  sw_lattice_args lattice;
  sw_section section; /* as given */
  sw_vec normal;      /* where the lattice's x goes; NAN = anywhere [-] */
  int curved;         /* 1: unstressed as it is drawn */
  double rest_twist;  /* [rad/m] */
} sw_strand_plan;

/* SW_EINVAL when so many rings of so many particles are more than fit. */
sw_status sw_strand_check_count(const sw_strand_plan *plan, size_t rings, size_t per_ring,
                                sw_error *err);
/* How many slices the wire of this length has when nobody says. */
sw_status sw_strand_slices(const sw_strand_plan *plan, const sw_beam *beam, double length,
                           size_t *out, sw_error *err);
/* How sections lie along the nodes of a mesh. */
typedef struct sw_strand_lie {
  const double *frames;      /* (nodes x 6) tangent, where the lattice's x goes [-] */
  const double *strains;     /* (nodes x 4) of the beam, as a cell has them [-], [1/m] */
  const unsigned char *ring; /* (nodes) 0: not a ring but a particle of a line, which stretches and
                              * bends as a rod but is not twisted; or NULL: all are rings */
  double spacing;            /* of rings side by side, when some are not [m] */
} sw_strand_lie;

/* A strand along the nodes of an even mesh; lie NULL: as the mesh lies, untwisted, sections as
 * they are without load. Frees nothing of *out on failure. */
sw_status sw_strand_new(const sw_strand_plan *plan, const sw_beam *beam, const sw_mesh *mesh,
                        const sw_strand_lie *lie, sw_strand *out, sw_error *err);
void sw_strand_free(sw_strand *strand);
void sw_strand_calibrated_retain(void *calibrated);
void sw_strand_calibrated_release(void *calibrated); /* NULL is allowed */
/* A copy that shares what never changes; of a strand without a web nothing. SW_ENOMEM. */
sw_status sw_strand_copy(const sw_strand *from, sw_strand *to);

/* On a tape; placed: it says where the particles are, for nothing else does. */
void sw_tape_strand(sw_tape *tape, sw_strand *strand, int placed);

#endif
