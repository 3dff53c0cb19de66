/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads mesh files by Assimp, from memory only. */
#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "shape/mesh_read.h"
#include "shape/mesh_words.h"

/* --- a file system of one file -------------------------------------------------- */

/* Assimp's own memory reader would look for materials and buffers on the disk; this one has a
 * single file. */
typedef struct memory_file {
  const char *bytes;
  size_t size, at; /* [B] */
  char name[32];
  int starved; /* 1: out of memory while opening */
} memory_file;

static size_t file_read(struct aiFile *file, char *out, size_t size, size_t count) {
  memory_file *f = (memory_file *)(void *)file->UserData;
  const size_t whole = size ? (f->size - f->at) / size : 0;
  const size_t n = count < whole ? count : whole;
  memcpy(out, f->bytes + f->at, n * size);
  f->at += n * size;
  return n;
}
static size_t file_write(struct aiFile *file SW_UNUSED, const char *bytes SW_UNUSED,
                         size_t size SW_UNUSED, size_t count SW_UNUSED) {
  return 0;
}
static size_t file_tell(struct aiFile *file) { return ((memory_file *)(void *)file->UserData)->at; }
static size_t file_size(struct aiFile *file) {
  return ((memory_file *)(void *)file->UserData)->size;
}
static void file_flush(struct aiFile *file) { (void)file; }
static enum aiReturn file_seek(struct aiFile *file, size_t offset, enum aiOrigin origin) {
  memory_file *f = (memory_file *)(void *)file->UserData;
  const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? f->at : f->size;
  const size_t to = from + offset; /* Assimp passes negative offsets wrapped around */
  if (to > f->size) return aiReturn_FAILURE;
  f->at = to;
  return aiReturn_SUCCESS;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *name, const char *mode SW_UNUSED) {
  memory_file *f = (memory_file *)(void *)io->UserData;
  if (strcmp(name, f->name) != 0) return NULL;
  struct aiFile *file = sw_alloc(1, sizeof *file);
  f->starved = !file;
  if (!file) return NULL;
  f->at = 0;
  *file = (struct aiFile){file_read, file_write, file_tell,    file_size,
                          file_seek, file_flush, (aiUserData)f};
  return file;
}
static void close_file(struct aiFileIO *io SW_UNUSED, struct aiFile *file) { sw_free(file); }

/* --- triangles ------------------------------------------------------------ */

static void count(const struct aiScene *scene, size_t *vertices, size_t *triangles) {
  *vertices = *triangles = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; m++) {
    *vertices += scene->mMeshes[m]->mNumVertices;
    *triangles += scene->mMeshes[m]->mNumFaces;
  }
}

/* Copies a mesh. 0: a face has a corner that does not exist; Assimp does not check the indices of
 * all formats. */
static int add_mesh(const struct aiMesh *mesh, sw_mesh_data *out) {
  const int first = (int)out->vertex_count;
  for (unsigned v = 0; v < mesh->mNumVertices; v++) {
    const struct aiVector3D p = mesh->mVertices[v];
    sw_store(out->vertices + 3 * out->vertex_count++, sw_v((double)p.x, (double)p.y, (double)p.z));
  }
  for (unsigned f = 0; f < mesh->mNumFaces; f++) {
    const struct aiFace face = mesh->mFaces[f];
    if (face.mNumIndices != 3) continue; /* points and lines have no area */
    int *to = out->indices + 3 * out->triangle_count++;
    for (int k = 0; k < 3; k++) {
      if (face.mIndices[k] >= mesh->mNumVertices) return 0;
      to[k] = first + (int)face.mIndices[k];
    }
  }
  return 1;
}

static sw_status copy(const char *object, const struct aiScene *scene, sw_mesh_data *out,
                      sw_error *err) {
  size_t vertices, triangles;
  count(scene, &vertices, &triangles);
  if (vertices > INT_MAX / 3 || triangles > INT_MAX / 3)
    return sw_fail(err, SW_ELIMIT, "%s: data has %zu points, too many", object, vertices);
  out->vertices = sw_alloc(3 * vertices, sizeof *out->vertices);
  out->indices = sw_alloc(3 * triangles, sizeof *out->indices);
  if (!out->vertices || !out->indices) {
    sw_free(out->vertices), sw_free(out->indices);
    *out = (sw_mesh_data){0};
    return sw_fail(err, SW_ENOMEM, "%s: out of memory", object);
  }
  int whole = 1;
  for (unsigned m = 0; m < scene->mNumMeshes && whole; m++)
    whole = add_mesh(scene->mMeshes[m], out);
  if (whole) return SW_OK;
  sw_free(out->vertices), sw_free(out->indices);
  *out = (sw_mesh_data){0};
  return sw_fail(err, SW_EFORMAT, "%s: data has a face whose corner is not among its points",
                 object);
}

/* Says in plain words what the library's text means. */
static const char *plain_of(const char *text) {
  static const struct {
    const char *part, *plain;
  } known[] = {{"No output meshes", "it has no triangles"},
               {"No meshes remaining", "it has no triangles"},
               {"no valid faces", "it has no triangles"},
               {"too small", "it has no triangles"},
               {"index out of range", "a face names a point that the file does not have"},
               {"Cannot parse", "it has a word where a number should be"},
               {"No suitable reader", "it does not begin as such a file does"}};
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
    if (strstr(text, known[k].part)) return known[k].plain;
  return "it is damaged, or of a kind that is not read";
}

static sw_status unreadable(const sw_mesh_file *from, const char *text, sw_error *err) {
  char shown[SW_WORDS_SHOWN];
  sw_words_show((sw_words){text, text + strlen(text)}, shown);
  return sw_fail(err, SW_EFORMAT,
                 "%s: data is not readable as %s: %s; write the file anew (the reader says: %s%s)",
                 from->object, from->format, plain_of(text), shown,
                 strlen(text) >= SW_WORDS_SHOWN ? "..." : "");
}

sw_status sw_mesh_read(const sw_mesh_file *from, sw_mesh_data *out, sw_error *err) {
  const unsigned steps =
      aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices;
  memory_file file = {from->bytes, from->byte_count, 0, "", 0};
  struct aiFileIO io = {open_file, close_file, (aiUserData)&file};
  *out = (sw_mesh_data){0};
  snprintf(file.name, sizeof file.name, "mesh.%s", from->format);
  struct aiPropertyStore *settings = aiCreatePropertyStore();
  if (!settings) return sw_fail(err, SW_ENOMEM, "%s: out of memory", from->object);
  aiSetImportPropertyInteger(settings, AI_CONFIG_PP_SBP_REMOVE,
                             aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const struct aiScene *scene = aiImportFileExWithProperties(file.name, steps, &io, settings);
  aiReleasePropertyStore(settings);
  if (!scene && file.starved) return sw_fail(err, SW_ENOMEM, "%s: out of memory", from->object);
  if (!scene) return unreadable(from, aiGetErrorString(), err);
  const sw_status status = copy(from->object, scene, out, err);
  aiReleaseImport(scene);
  return status;
}
