/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Input and output of the forces on one wire in one evaluation. Forces that depend only on the
 * edges (stretch, bend) write gradients and second derivatives with respect to edge vectors; the
 * system converts these to node forces and matrix blocks once for all of them. Forces on nodes
 * (gravity, drag, contact) write node forces and node blocks.
 *
 * Edge arrays are one array per component, so that loops over edges vectorise. Each has zeros
 * before index 0 and after its last item, so that gathering to nodes needs no special case at the
 * ends. */
#ifndef SW_STATE_FIELD_H
#define SW_STATE_FIELD_H

#include <stddef.h>

#include "base/status.h"
#include "base/vec.h"
#include "state/first_stage.h"
#include "state/plan.h"

/* Parts that an evaluation must compute. */
enum {
  SW_WANT_FORCE = 1,     /* gradients and node forces */
  SW_WANT_STIFFNESS = 2, /* second derivatives, with velocity_rate times damping */
  SW_WANT_ENERGY = 4,    /* add to energy */
  SW_WANT_POWER = 8      /* add to power */
};

enum { SW_LANES = 8 }; /* zeros around each edge array [-] */

struct sw_blocks;

typedef struct sw_field {
  const sw_plan *plan;
  unsigned want;
  double time;           /* [s] */
  double velocity_rate;  /* d velocity / d position of the stage: 1/hbar, 0 in statics [1/s] */
  int statics;           /* stored tension may be negative in the stiffness */
  const double *x;       /* (n x 3) node positions [m] */
  const double *v;       /* (n x 3) node velocities [m/s] */
  sw_first_stage first;  /* at a commit: the first stage, of its nodes */
  const double *tension; /* (m) stored axial force of the mixed Newton, or NULL [N] */
  const double *gravity; /* (3) [m/s2] */

  /* Axial strains, for dashpots. Over a step, node velocities do not give the change of length of
   * an edge that turns. While a stage is solved: strain_past, from which the rate counts (the same
   * mean of earlier strains as the positions from which the stage starts), and strain, which goes
   * with tension. At a state: strain_rate, for read-outs. NULL: rates follow from the velocities.
   */
  const double *strain_past; /* (m) [-] */
  const double *strain;      /* (m) [-] */
  const double *strain_rate; /* (m) [1/s] */

  const double *hold_directors; /* (holds x 2 x 3) directors of the holds [-] */
  const double *hold_turns;     /* (holds x 3) angular velocities of the holds [rad/s] */
  const double *hold_flows;     /* (holds) speeds of wire that leaves them along the arc [m/s] */
  /* The same for edges at clamps, (clamps x 3). While a stage is solved: their past directions,
   * from which the rate counts, turned along with the hold. At a state: how fast they turn away
   * from the hold. NULL: rates follow from the velocities [-], [1/s] */
  const double *clamp_past, *clamp_rate;
  int cautious;          /* iterations do not converge: overestimate stiffness that jumps */
  const double *history; /* of the force that is being evaluated, or NULL */

  /* twist of the plan's spans; NULL when there is none */
  const double *twist;     /* (spans) total twist at this evaluation [rad] */
  double *twist_slope[3];  /* (edges) d twist / d edge vector, to be filled [rad/m] */
  double *twist_stiffness; /* (spans) second derivative along the slope, added to [N m] */

  /* material frames; NULL for a wire without them */
  const double *normals[3];   /* (m) first material axis of each edge, each component; up to three
                                 items beyond the ends may be read, as garbage [-] */
  const double *hinge_twist;  /* (n + clamps) turn from edge to edge, then at clamps [rad] */
  const double *hold_normals; /* (holds x 2 x 3) first material axis at the holds, or axis of their
                                 give [-] */
  double *spin;         /* (m) d energy / d turn of an edge about itself, to be added to [N m] */
  double *spin_own;     /* (m) second derivative [N m] */
  double *spin_next;    /* (n) at node i: spins of edges i-1 and i [N m] */
  double *spin_edge[9]; /* three groups of 3 components: (m) edge e with its own spin; (n) at node
                           i: edge i with spin i-1; edge i-1 with spin i [N] */
  double *spin_node[6]; /* for a wire that rolls: two groups of 3 components, (n) node i with the
                           spins of edges i-1 and i; else NULL [N] */

  /* geometry of the edges, filled by sw_field_geometry */
  double *length;     /* (m) [m] */
  double *reciprocal; /* (m) 1 / length [1/m] */
  double *tangent[3]; /* (m) each component [-] */

  int is_judged; /* 1: the geometry is still of the trial whose energies were measured */

  /* to be added to */
  double *gradient[3]; /* (m) d energy / d edge vector [N] */
  double *own[6];      /* (m) second derivative, upper half xx xy xz yy yz zz [N/m] */
  double *next[9];     /* (n) at node i: block edge i-1 with edge i, row by row [N/m] */
  double *force;       /* (n x 3) forces on nodes [N] */
  double *rows;        /* (n x SW_ROW_SIZE) node blocks of the matrix [N/m] */
  double energy;       /* [J] */
  double bending; /* part of energy that corrects the wire's own bending, or another part that the
                     force names [J] */
  double power;   /* taken from the motion, by forces that dissipate [W] */

  /* for particles of a web; NULL for nodes in a line */
  double *blocks; /* values of the matrix, 3 x 3 blocks [N/m] */
  /* Returns the slot of the block in particle i's rows, j's columns (j < i); SIZE_MAX if the matrix
   * has none. */
  size_t (*slot_of)(const struct sw_blocks *matrix, size_t i, size_t j);
  const struct sw_blocks *matrix;
  size_t block_stride;       /* from one row of a block to the next [-] */
  const size_t *own_slot;    /* (n) where a particle's own block begins */
  const size_t *link_slot;   /* (links) row of the larger number, column of the smaller one */
  const size_t *fold_slot;   /* (folds x 3) the same for pairs a b, a c, b c */
  const size_t *crease_slot; /* (creases x 6) the same for a b, c b, d b, a c, a d, c d */
  const size_t *slide_slot;  /* (slides x 6) the same for nodes 1 0, 2 0, 2 1, 3 0, 3 1, 3 2 */
  const size_t *solid_slot;  /* (solids x 28) the same for corners 0 1, 0 2, 1 2, 0 3, ... */

  /* per-hinge scratch */
  double *scratch[4]; /* (n) */
} sw_field;

/* Computes edge lengths and tangents from positions x. */
void sw_field_geometry(sw_field *field);

/* Sets all sums of forces to zero. It stops halfway if the user wants to stop: check sw_interrupted
 * before using the sums. */
void sw_field_clear(sw_field *field);

/* Returns component k of the total force on node i [N]. */
static inline double sw_field_force(const sw_field *f, size_t i, size_t k) {
  return f->force[3 * i + k] + f->gradient[k][i] - *(f->gradient[k] + i - 1);
}

/* Allocates all arrays of a field for a plan with n nodes, in one block that is returned through
 * *block (free with sw_free). SW_ENOMEM. */
sw_status sw_field_new(sw_field *field, size_t nodes, void **block);

enum {
  SW_FIELD_ROW = 24
}; /* numbers in a node's row; its own block (xx xy xz yy yz zz) comes first [-] */

enum { SW_FIELD_SOLID_PAIRS = SW_WEB_SOLID_NODES * (SW_WEB_SOLID_NODES - 1) / 2 }; /* [-] */

enum { SW_FIELD_CREASE_PAIRS = 6 }; /* [-] */

enum { SW_FIELD_SLIDE_PAIRS = SW_SLIDE_NODES * (SW_SLIDE_NODES - 1) / 2 }; /* [-] */

/* Adds a symmetric stiffness between particles a and b: K (upper half) to the own block of each, -K
 * between them. slot: of the block between them. The own parts go to the particles' rows, where six
 * numbers lie side by side, and from there to the matrix once for all pairs. */
static inline void sw_field_add_pair(sw_field *f, size_t a, size_t b, size_t slot,
                                     const double K[6]) {
  static const int whole[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  double *first = f->rows + SW_FIELD_ROW * a, *second = f->rows + SW_FIELD_ROW * b;
  double *between = f->blocks + slot;
  for (int i = 0; i < 6; i++) first[i] += K[i];
  for (int i = 0; i < 6; i++) second[i] += K[i];
  for (int i = 0; i < 3; i++, between += f->block_stride)
    for (int j = 0; j < 3; j++) between[j] -= K[whole[3 * i + j]];
}

/* Adds second derivatives H (row by row, first by a, then by b) between two different particles. */
static inline void sw_field_add_block(sw_field *f, size_t a, size_t b, size_t slot, const double *H,
                                      size_t stride) {
  double *to = f->blocks + slot;
  const size_t down = a > b ? stride : 1, across = a > b ? 1 : stride;
  for (size_t i = 0; i < 3; i++, to += f->block_stride)
    for (size_t j = 0; j < 3; j++) to[j] += H[i * down + j * across];
}

/* Direction of an edge [-]. */
static inline sw_vec sw_field_tangent(const sw_field *field, size_t edge) {
  return sw_vec_across(field->tangent, edge);
}

/* Adds stiffness to a particle's own block, nine numbers row by row [N/m]. */
static inline void sw_field_add_own(sw_field *field, size_t particle, const double *H) {
  double *to = field->blocks + field->own_slot[particle];
  for (size_t i = 0; i < 3; i++)
    for (size_t j = 0; j < 3; j++) to[i * field->block_stride + j] += H[3 * i + j];
}

/* Adds d energy / d edge vector [N]. */
static inline void sw_field_add_gradient(sw_field *field, size_t edge, sw_vec g) {
  field->gradient[0][edge] += g.x;
  field->gradient[1][edge] += g.y;
  field->gradient[2][edge] += g.z;
}

#endif
