/* A language module for LTSmin: the kernel behind its Partitioned Next-State Interface (PINS).
 *
 * A state has for each rebec the content of its local state, as a chunk, and `status`: "runs", or
 * "start" where constructors may fail, or how a step has failed. A state with a failure has the local
 * states before the step, and goes on for ever as it is, so that a deadlock is a deadlock of the model.
 * What the kernel cannot finish ends the tool: there is no answer then.
 *
 * Steps are one group, which may read and write all: dense, as any of them may let time pass for all.
 */
#include <stdio.h>

#include <ltsmin/pins.h>
#include <ltsmin/pins-util.h>
#include <ltsmin/dlopen-api.h>

#include "common.h"

enum phase { RUNS, STARTS, FAILS }; /* with a failure of machine.h: FAILS + failure - 1 */

static const char *const statuses[] = {
    "runs", "start", "assertion", "deadline", "overflow", "index", "division", "null", "time",
};
enum { STATUSES = sizeof statuses / sizeof *statuses, FAILURE = 255, ACTION = 0, TIME_PASSED = 1 };

/* What a number of one side is on the other, NONE where that is not known. */
struct numbers {
    uint32_t *of;
    size_t known;
};

struct module {
    model_t pins;
    struct kernel *kernel;
    int rebecs, first_type; /* of the chunks: one type for each rebec */
    struct numbers *chunks, *locals; /* by numbers of local states, and of chunks */
    uint32_t *state;
    int *reached;
};

static void end(const char *why)
{
    fprintf(stderr, "%s: %s\n", pins_plugin_name, why);
    ltsmin_abort(FAILURE);
}

static void *needed(void *memory)
{
    if (!memory)
        end("there is no memory");
    return memory;
}

static void expect_whole(enum answer answer)
{
    if (answer != COMPLETE)
        end(answer == UNENDING ? "a body does not end" : "there is no memory");
}

/* --- local states, and chunks */

static uint32_t *place(struct numbers *n, uint32_t number)
{
    if (number >= n->known) {
        size_t known = number + number / 2 + 64;
        n->of = needed(realloc(n->of, known * sizeof *n->of));
        memset(n->of + n->known, 255, (known - n->known) * sizeof *n->of);
        n->known = known;
    }
    return n->of + number;
}

static int chunk_of(struct module *m, int rebec, uint32_t number)
{
    uint32_t *known = place(m->chunks + rebec, number);
    if (*known == NONE) {
        const unsigned char *content;
        size_t length = kernel_content(m->kernel, (uint32_t)rebec, number, &content);
        chunk text = chunk_ld((chunk_len)length, (char *)content);
        *known = (uint32_t)pins_chunk_put(m->pins, m->first_type + rebec, text);
        *place(m->locals + rebec, *known) = number;
    }
    return (int)*known;
}

static uint32_t local_of(struct module *m, int rebec, int number)
{
    uint32_t *known = place(m->locals + rebec, (uint32_t)number);
    if (*known == NONE) {
        chunk text = pins_chunk_get(m->pins, m->first_type + rebec, number);
        *known = kernel_number(m->kernel, (uint32_t)rebec, (unsigned char *)text.data);
        if (*known == NONE)
            end("there is no memory");
    }
    return *known;
}

/* The state of a vector, in the kernel's numbers. */
static const uint32_t *state_of(struct module *m, const int *vector)
{
    for (int r = 0; r < m->rebecs; r++)
        m->state[r] = local_of(m, r, vector[r]);
    return m->state;
}

/* --- steps */

struct giving {
    struct module *module;
    const int *source;
    TransitionCB give;
    void *to;
    int count;
};

static void give(struct giving *g, int actor, int64_t time)
{
    int labels[] = {actor < 0 ? g->module->rebecs : actor, time > INT32_MAX ? INT32_MAX : (int)time};
    transition_info_t info = GB_TI(labels, 0);
    g->give(g->to, &info, g->module->reached, NULL);
    g->count++;
}

static void give_step(void *visitor, const struct transition *step)
{
    struct giving *g = visitor;
    struct module *m = g->module;
    int *to = m->reached, status = to[m->rebecs] = step->state ? RUNS : FAILS + step->kind - 1;
    for (int r = 0; r < m->rebecs; r++)
        to[r] = status == RUNS ? chunk_of(m, r, step->state[r]) : g->source[r];
    give(g, step->actor, step->time);
}

static int next_state(model_t self, int group, int *source, TransitionCB callback, void *to)
{
    struct module *m = GBgetContext(self);
    struct giving giving = {m, source, callback, to, 0};
    int status = source[m->rebecs];
    size_t made;
    (void)group;
    if (status == STARTS) {
        expect_whole(kernel_initial(m->kernel, give_step, &giving));
    } else if (status == RUNS) {
        const uint32_t *state = state_of(m, source);
        expect_whole(kernel_successors(m->kernel, state, 1, &made, give_step, &giving));
    } else {
        memcpy(m->reached, source, ((size_t)m->rebecs + 1) * sizeof *source);
        give(&giving, -1, 0);
    }
    return giving.count;
}

/* --- labels: the properties' atoms */

static int label_of(model_t self, int label, int *source)
{
    struct module *m = GBgetContext(self);
    if (source[m->rebecs] == STARTS)
        return 0;
    kernel_observe(m->kernel, state_of(m, source));
    struct valuation found = kernel_evaluate(m->kernel, atoms[label].predicate);
    expect_whole(found.answer);
    if (!found.defined)
        end("a property divides by zero, or reads beyond an array");
    return found.value != 0;
}

/* --- the model as LTSmin asks for it */

static int type_of(lts_type_t type, const char *name, data_format_t format)
{
    return lts_type_put_type(type, name, format, NULL);
}

static void describe_labels(lts_type_t type)
{
    int boolean = type_of(type, "boolean", LTStypeBool);
    lts_type_set_state_label_count(type, ATOMS);
    for (int i = 0; i < ATOMS; i++) {
        lts_type_set_state_label_name(type, i, atoms[i].name);
        lts_type_set_state_label_typeno(type, i, boolean);
    }
    lts_type_set_edge_label_count(type, 2);
    lts_type_set_edge_label_name(type, ACTION, "action");
    lts_type_set_edge_label_typeno(type, ACTION, type_of(type, "action", LTStypeEnum));
    lts_type_set_edge_label_name(type, TIME_PASSED, "passed");
    lts_type_set_edge_label_typeno(type, TIME_PASSED, type_of(type, "passed", LTStypeDirect));
}

static void describe_states(struct module *m, lts_type_t type)
{
    char name[32];
    lts_type_set_state_length(type, m->rebecs + 1);
    for (int r = 0; r < m->rebecs; r++) {
        snprintf(name, sizeof name, "local %d", r);
        int number = type_of(type, name, LTStypeChunk);
        m->first_type = r ? m->first_type : number;
        lts_type_set_state_name(type, r, slots[r]);
        lts_type_set_state_typeno(type, r, number);
    }
    lts_type_set_state_name(type, m->rebecs, STATUS);
    lts_type_set_state_typeno(type, m->rebecs, type_of(type, "status", LTStypeEnum));
}

/* Names the values of what is an enumeration; they must be the same in all workers. */
static void name_values(struct module *m, lts_type_t type)
{
    int status = lts_type_find_type(type, "status"), action = lts_type_find_type(type, "action");
    for (int i = 0; i < STATUSES; i++)
        pins_chunk_put_at(m->pins, status, chunk_str(statuses[i]), i);
    for (int r = 0; r <= m->rebecs; r++)
        pins_chunk_put_at(m->pins, action, chunk_str(actors[r]), r);
}

static matrix_t *dense(int rows, int columns)
{
    matrix_t *matrix = needed(malloc(sizeof *matrix));
    dm_create(matrix, rows, columns);
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++)
            dm_set(matrix, row, column);
    return matrix;
}

struct beginning {
    struct module *module;
    int steps, states;
};

/* Keeps the initial state in `reached`. */
static void keep_initial(void *visitor, const struct transition *step)
{
    struct beginning *b = visitor;
    struct module *m = b->module;
    b->steps++;
    if (!step->state)
        return;
    b->states++;
    for (int r = 0; r < m->rebecs; r++)
        m->reached[r] = chunk_of(m, r, step->state[r]);
}

/* Begins at the only initial state, or at one whose steps are what constructors do. */
static void begin_at(struct module *m)
{
    struct beginning found = {m, 0, 0};
    expect_whole(kernel_initial(m->kernel, keep_initial, &found));
    int only = found.steps == 1 && found.states == 1;
    m->reached[m->rebecs] = only ? RUNS : STARTS;
    for (int r = 0; r < m->rebecs && !only; r++)
        m->reached[r] = pins_chunk_put(m->pins, m->first_type + r, chunk_str(""));
    GBsetInitialState(m->pins, m->reached);
}

void pins_model_init(model_t pins)
{
    struct module *m = needed(calloc(1, sizeof *m));
    size_t rebecs = (size_t)rebsync_model.rebecs;
    m->pins = pins;
    m->kernel = needed(kernel_new(&rebsync_model, SEMANTICS, 0));
    m->rebecs = (int)rebecs;
    m->chunks = needed(calloc(rebecs, sizeof *m->chunks));
    m->locals = needed(calloc(rebecs, sizeof *m->locals));
    m->state = needed(calloc(rebecs, sizeof *m->state));
    m->reached = needed(calloc(rebecs + 1, sizeof *m->reached));
    GBsetContext(pins, m);
    lts_type_t type = lts_type_create();
    describe_states(m, type);
    describe_labels(type);
    lts_type_validate(type);
    GBsetLTStype(pins, type);
    name_values(m, type);
    GBsetDMInfo(pins, dense(1, m->rebecs + 1));
    GBsetStateLabelInfo(pins, dense(ATOMS, m->rebecs + 1));
    begin_at(m);
    GBsetNextStateLong(pins, next_state);
    GBsetStateLabelLong(pins, label_of);
}

#include "kernel.c"
