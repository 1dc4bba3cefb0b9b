/* The kernel; what it does for others is said in kernel.h. */
#include "collecting.h"
#include "expansion.h"
#include "observing.h"

/* Goes on after `escaped = setjmp(...)`, with where the call before goes to on the outside. */
#define ENTER(k)                                                                                   \
    struct escape here, *outside = (k)->escape;                                                    \
    (k)->escape = &here;                                                                           \
    int escaped = setjmp(here.to)

#define LEAVE(k, answer)                                                                           \
    do {                                                                                           \
        (k)->escape = outside;                                                                     \
        return answer;                                                                             \
    } while (0)

/* --- its life */

static void make_local(struct kernel *k, struct local *l)
{
    size_t variables = 1;
    for (uint32_t r = 0; r < k->rebecs; r++) {
        size_t cells = (size_t)k->model->rebec[r].cells;
        variables = cells > variables ? cells : variables;
    }
    l->variables = zeroed(k->escape, variables, sizeof(cell));
    room_for_bag(k, l, 1);
    l->message = zeroed(k->escape, k->model->stride, sizeof(cell));
}

static void make_observed(struct kernel *k)
{
    k->views = zeroed(k->escape, k->rebecs, sizeof *k->views);
    k->machine.states = k->views;
    k->observed = zeroed(k->escape, k->rebecs, sizeof *k->observed);
    for (uint32_t r = 0; r < k->rebecs; r++) {
        if (!k->model->observed[r])
            continue;
        size_t cells = (size_t)OBSERVED * k->model->rebec[r].cells;
        k->observed[r].variables = zeroed(k->escape, cells, sizeof(cell));
        memset(k->observed[r].ids, 255, sizeof k->observed[r].ids);
    }
}

static void make_actors(struct kernel *k)
{
    k->actors = zeroed(k->escape, k->rebecs, sizeof *k->actors);
    for (uint32_t r = 0; r < k->rebecs; r++) {
        enlarge_memo(k, &k->actors[r].received, 1);
        enlarge_memo(k, &k->actors[r].passed, 1);
    }
    k->next = zeroed(k->escape, k->rebecs, sizeof *k->next);
    k->acting = zeroed(k->escape, k->rebecs, sizeof *k->acting);
}

static void make_machine(struct kernel *k)
{
    const struct model *m = k->model;
    k->covered = zeroed(k->escape, 2 * (size_t)m->branches, 1);
    k->uncounted = zeroed(k->escape, 2 * (size_t)m->branches, 1);
    k->served = zeroed(k->escape, (size_t)m->servers, 1);
    make_local(k, &k->scratch);
    make_local(k, &k->result);
    k->machine.variables = k->result.variables;
    k->machine.covered = k->covered;
    k->machine.stride = m->stride;
    k->machine.splits = k->semantics == TTS;
    k->machine.message = k->scratch.message;
    k->machine.kernel = k;
    k->machine.more = more;
    for (uint32_t r = 0; r < k->rebecs; r++)
        k->machine.places += m->rebec[r].capacity;
}

struct kernel *kernel_new(const struct model *model, enum semantics semantics, int hashes)
{
    struct kernel *k = calloc(1, sizeof *k);
    if (!k)
        return NULL;
    k->model = model;
    k->rebecs = (uint32_t)model->rebecs;
    k->semantics = semantics;
    k->hashes = hashes;
    k->symmetries.order = 1;
    k->instructions = INT64_MAX;
    ENTER(k);
    if (escaped) {
        kernel_free(k);
        return NULL;
    }
    make_actors(k);
    make_machine(k);
    make_observed(k);
    LEAVE(k, k);
}

static void free_local(struct local *l)
{
    free(l->variables);
    free(l->bag);
    free(l->message);
    free(l->frames);
}

static void free_actor(struct actor *a)
{
    free(a->components.data);
    free(a->bytes.data);
    free(a->hashes.data);
    free(a->table);
    free(a->received.entries);
    free(a->passed.entries);
    free(a->renamed.entries);
}

void kernel_free(struct kernel *k)
{
    if (!k)
        return;
    for (uint32_t r = 0; k->actors && r < k->rebecs; r++)
        free_actor(k->actors + r);
    for (uint32_t r = 0; k->observed && r < k->rebecs; r++)
        free(k->observed[r].variables);
    free_local(&k->scratch);
    free_local(&k->result);
    struct machine *m = &k->machine;
    void *parts[] = {
        k->actors, k->observed, k->views, k->next, k->acting, k->covered, k->uncounted, k->served,
        m->stack, m->frames, m->choices, m->options, m->sends, k->text.data, k->messages.data,
        k->outcomes.data, k->sends.data, k->message_table, k->persistent, k->names, k->origins,
        k->positions, k->orbit, k->references, k->colours, k->turned, k->watch.cells.data,
        k->watch.frames.data};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
    free(k);
}

void kernel_limit(struct kernel *k, int64_t instructions)
{
    k->instructions = instructions;
}

void kernel_watch(struct kernel *k, void (*look)(int *goes_on))
{
    k->look = look;
    k->looked = clock_now();
}

int kernel_persistent(struct kernel *k, const int32_t *candidates, int count)
{
    ENTER(k);
    if (!escaped) {
        k->persistent = copied(k->escape, candidates, (size_t)count * (k->rebecs + 1));
        k->persistent_count = (uint32_t)count;
    }
    LEAVE(k, !escaped);
}

int kernel_symmetry(struct kernel *k, struct symmetries found, const int32_t *names,
                    const int32_t *origins, const int32_t *positions, const int32_t *orbit,
                    const int32_t *references)
{
    size_t rebecs = k->rebecs;
    ENTER(k);
    if (escaped)
        LEAVE(k, 0);
    k->names = copied(k->escape, names, rebecs * (found.order + found.movable));
    k->origins = copied(k->escape, origins, rebecs * found.order);
    k->positions = copied(k->escape, positions, rebecs);
    k->orbit = copied(k->escape, orbit, rebecs);
    k->references =
        (struct reference *)copied(k->escape, references, 3 * (size_t)found.references);
    k->colours = zeroed(k->escape, rebecs, sizeof *k->colours);
    k->turned = zeroed(k->escape, rebecs, sizeof *k->turned);
    for (uint32_t r = 0; r < k->rebecs; r++)
        enlarge_memo(k, &k->actors[r].renamed, 1);
    k->symmetries = found;
    LEAVE(k, 1);
}

/* --- steps */

static void construct_all(struct kernel *k)
{
    uint32_t *ids = zeroed(k->escape, k->rebecs, sizeof *ids);
    struct local *l = &k->result;
    for (uint32_t r = 0; r < k->rebecs; r++) {
        const struct rebec *rebec = k->model->rebec + r;
        memcpy(l->variables, rebec->blank, rebec->cells * sizeof(cell));
        l->busy = l->clock = 0;
        l->messages = l->frame_count = l->frame_cells = 0;
        ids[r] = number_of(k, r, l);
    }
    construct_from(k, ids, 0);
    free(ids);
}

enum answer kernel_initial(struct kernel *k, visit *to, void *visitor)
{
    k->visit = to;
    k->visitor = visitor;
    k->ordinal = 0;
    k->starting = 1;
    ENTER(k);
    if (!escaped)
        construct_all(k);
    LEAVE(k, escaped);
}

enum answer kernel_successors(struct kernel *k, const uint32_t *states, size_t count, size_t *made,
                              visit *to, void *visitor)
{
    k->visit = to;
    k->visitor = visitor;
    k->starting = 0;
    *made = 0;
    ENTER(k);
    if (escaped)
        LEAVE(k, escaped);
    for (; *made < count; ++*made) {
        k->ids = states + *made * k->rebecs;
        if (!expand(k))
            LEAVE(k, UNENDING);
    }
    LEAVE(k, COMPLETE);
}

/* --- states */

static inline uint64_t local_fingerprint(struct kernel *k, uint32_t rebec, uint32_t number)
{
    return k->hashes ? ((uint64_t *)k->actors[rebec].hashes.data)[number] : content_hash(k, rebec, number);
}

uint64_t kernel_fingerprint(struct kernel *k, const uint32_t *state)
{
    uint64_t hash = UINT64_C(0xE7037ED1A0B428DB);
    for (uint32_t r = 0; r < k->rebecs; r++)
        hash = mixed(hash, local_fingerprint(k, r, state[r]));
    hash = mixed(hash, UINT64_C(0x8EBC6AF09C88C6E3));
    return hash ? hash : 1;
}

size_t kernel_content(struct kernel *k, uint32_t rebec, uint32_t number, const unsigned char **content)
{
    struct actor *a = k->actors + rebec;
    *content = (unsigned char *)a->bytes.data + component(k, rebec, number)->at;
    return length_of(a, number);
}

uint32_t kernel_number(struct kernel *k, uint32_t rebec, const unsigned char *content)
{
    ENTER(k);
    if (escaped)
        LEAVE(k, NONE);
    take_local(k, rebec, content, &k->scratch);
    uint32_t number = number_of(k, rebec, &k->scratch);
    LEAVE(k, number);
}

void kernel_meet(struct kernel *k, void (*meet)(void *of, uint32_t rebec, uint32_t number), void *of)
{
    k->meet = meet;
    k->meeter = of;
}

uint32_t kernel_locals(const struct kernel *k, uint32_t rebec)
{
    return (uint32_t)k->actors[rebec].components.count;
}

/* --- what holds */

void kernel_observe(struct kernel *k, const uint32_t *state)
{
    observe_state(k, state);
}

struct valuation kernel_evaluate(struct kernel *k, int32_t number)
{
    ENTER(k);
    if (escaped)
        LEAVE(k, ((struct valuation){(enum answer)escaped, 0, 0, 0, 0}));
    struct valuation found = valuation_of(k, number);
    LEAVE(k, found);
}

/* --- what it knows */

struct cut kernel_cut(const struct kernel *k)
{
    return k->cut;
}

void kernel_covered(const struct kernel *k, unsigned char *served, unsigned char *covered,
                    uint32_t *largest)
{
    memcpy(served, k->served, (size_t)k->model->servers);
    memcpy(covered, k->covered, 2 * (size_t)k->model->branches);
    for (uint32_t r = 0; r < k->rebecs; r++)
        largest[r] = k->actors[r].largest;
}

void kernel_forget(struct kernel *k, const unsigned char *served, const unsigned char *covered,
                   const uint32_t *largest)
{
    memcpy(k->served, served, (size_t)k->model->servers);
    memcpy(k->covered, covered, 2 * (size_t)k->model->branches);
    for (uint32_t r = 0; r < k->rebecs; r++) {
        k->actors[r].largest = largest[r];
        empty(&k->actors[r].received);
        for (uint32_t id = 0; id < kernel_locals(k, r); id++)
            component(k, r, id)->outcomes = NONE;
    }
    forget_outcomes(k);
}

size_t kernel_size(const struct kernel *k)
{
    return size_of_locals(k);
}

void kernel_collect(struct kernel *k, uint32_t *numbers)
{
    for (uint32_t r = 0; r < k->rebecs; r++) {
        uint32_t count = kernel_locals(k, r);
        collect_actor(k, r, numbers);
        numbers += count;
    }
    forget_outcomes(k);
}
