"""The table of diagnostic codes: what each stands for, in one line.

RS1xx syntax, RS2xx names, RS3xx types, RS4xx declarations and structure, RS5xx warnings about a
model that is accepted, RS6xx warnings about robotic models (thesis, section 3.2), RS7xx what
cannot be generated, RS8xx files, options and configuration, RS90x and RS91x properties and
questions, RS92x runs and state spaces, RS94x extraction, RS95x and RS96x model and code in step,
RS97x differences between two models, RS98x recorded runs, RS99x the computation graph.
"""

from __future__ import annotations

SYNTAX = {
    "RS101": "a token that the grammar does not allow here",
    "RS102": "a character that belongs to no token",
    "RS103": "a comment or string that does not end",
    "RS104": "a keyword or section name that is misspelled",
    "RS105": "a missing token, such as `;`",
    "RS106": "a brace too many, or one missing",
    "RS107": "a nondeterministic expression written with `<` and `>`",
    "RS108": "a parameter without a type",
    "RS109": "the end of the file comes too early",
    "RS110": "a part of the language that rebsync recognises and refuses",
    "RS112": "a part of the model in the wrong place",
    "RS113": "a language beside Timed Rebeca, recognised and refused",
    "RS114": "a control character in a text or a comment",
    "RS115": "more words and signs than rebsync reads",
    "RS111": "nesting deeper than rebsync reads",
}

NAMES = {
    "RS201": "a type, class or interface that is not declared",
    "RS203": "a variable that is not declared",
    "RS204": "a message server, method or function that is not declared",
    "RS205": "a variable that the class does not have",
    "RS206": "a variable declared twice",
    "RS207": "a class or interface declared twice",
    "RS208": "a message server, method or constructor declared twice",
    "RS209": "a rebec of `main` whose name is taken",
    "RS210": "the name of a type, used for something else",
    "RS211": "a variable or method of another rebec",
    "RS212": "a rebec that `main` does not declare",
    "RS213": "`sender` outside of a message server",
    "RS214": "`super` in a class that extends no other",
}

TYPES = {
    "RS301": "an operator that is not defined for its operands",
    "RS302": "a value that does not fit the type of its place",
    "RS303": "a cast that goes neither up nor down",
    "RS304": "a condition that is not boolean",
    "RS305": "a number that is too large",
    "RS306": "a switch or case on something other than integers",
    "RS307": "alternatives that have no common type",
    "RS308": "an index into something that has no elements",
    "RS309": "an index that is not an integer",
    "RS310": "arguments that do not fit the declaration",
    "RS311": "arguments that fit several declarations",
    "RS312": "a time that is not an integer",
    "RS313": "`instanceof` on something other than rebecs and classes",
    "RS314": "an assignment to something that is not a variable",
    "RS315": "an assignment to a constant, a known rebec or a built-in variable",
    "RS316": "a list of initial values that does not fit its array",
    "RS317": "a text outside of `assertion`",
    "RS318": "a message to something that takes none",
    "RS319": "a message to `sender` whose class is not known",
    "RS320": "a value returned where none is wanted, or none where one is",
}

STRUCTURE = {
    "RS401": "a model without `main`",
    "RS402": "a model without classes",
    "RS403": "an env variable without a value",
    "RS404": "an env variable whose type or value is no constant",
    "RS405": "an initial value of a state variable or known rebec",
    "RS406": "a class or interface that descends from itself",
    "RS407": "a parent of the wrong kind",
    "RS408": "a class that leaves an inherited body open",
    "RS409": "a body that is missing, or one too many",
    "RS410": "an instance of something that has no instances",
    "RS411": "bindings that do not fit the known rebecs",
    "RS412": "a member without a type that is not the constructor",
    "RS413": "a message server or method with the name of its class",
    "RS414": "a member that does not fit the inherited one",
    "RS415": "`break` outside of a loop or switch",
    "RS416": "`continue` outside of a loop",
    "RS417": "a case that is not constant",
    "RS418": "a case that stands twice",
    "RS419": "a switch without cases, or a `default` out of place",
    "RS420": "a nondeterministic expression with fewer than two options",
    "RS421": "an option of a nondeterministic expression that is not constant",
    "RS422": "a nondeterministic expression outside of a message server",
    "RS423": "`after` or `deadline` on something other than a message",
    "RS424": "a constructor that sends to another rebec",
    "RS425": "a negative time",
    "RS426": "a known rebec that is no rebec",
    "RS427": "an annotation where it does not belong",
    "RS428": "a `@Move` that is not of the form `@Move(X+1, Y)`",
    "RS429": "a priority that is not a constant integer",
    "RS430": "`@priority` and `@globalPriority` in one model",
    "RS431": "a queue or an array without places",
    "RS432": "an abstract member of a class that is not abstract",
}

WARNINGS = {
    "RS501": "a state variable that is read before it is set",
    "RS502": "a known rebec that is never used",
    "RS503": "a message server that no one sends to",
    "RS504": "a state variable that is never read",
    "RS505": "a local variable that is never used",
    "RS506": "a deadline that is over before the message arrives",
    "RS507": "a statement that is never reached",
    "RS508": "a queue that the rebec's own messages overflow",
    "RS510": "an assertion whose outcome is known",
    "RS511": "a name that hides a built-in",
    "RS512": "an option of a nondeterministic expression that stands twice",
    "RS513": "a constant index outside of its array",
    "RS514": "a division by the constant zero",
    "RS515": "an env variable that is never used",
    "RS516": "a method that is never called",
    "RS517": "a class without an instance",
    "RS518": "a statement without effect",
    "RS519": "a priority where it has no effect",
    "RS520": "a method that can end without returning its value",
    "RS521": "a cast that older compilers read as one of the whole product",
}

ROBOTIC = {
    "RS601": "a controller that does not know a robot",
    "RS602": "a robot that does not know the controller",
    "RS603": "a sensor that does not send to itself after its rate",
    "RS604": "a sensor that is never started",
    "RS605": "a robot commanded other than through its port",
    "RS606": "a robot without a port for its controller",
    "RS607": "a class that moves but is no robot",
    "RS608": "an activity that moves without taking time",
    "RS609": "a port of a class that is no robot",
}

GENERATION = {
    "RS701": "a generated file that was edited by hand and would be overwritten",
    "RS702": "a package name that ROS, C or C++ uses already",
    "RS703": "an array of known rebecs",
    "RS704": "a priority between rebecs, which ROS cannot carry out",
    "RS705": "rebecs of one class with different constructors",
    "RS706": "a global priority, which holds only within a rebec",
    "RS707": "a sensor binding without its sensor",
    "RS708": "a package that was made from another model",
    "RS709": "a dialect that is not known, or that does not go with others",
    "RS710": "a package of which no licence, maintainer or holder of the copyright is known",
    "RS711": "a service or an action that the model does not answer",
    "RS712": "topics or services that would have one name",
    "RS713": "a model that needs more than the run-time part that packages share",
    "RS750": "a part of a model that the official compiler or RMC does not take",
    "RS751": "a part of a model that RMC runs differently",
    "RS752": "an option that RMC must be given for this model",
}

FILES = {
    "RS801": "a file or directory that does not exist",
    "RS802": "a directory where a file is wanted, or the reverse",
    "RS803": "a file or directory that may not be read or written",
    "RS804": "a file that is not UTF-8 text",
    "RS805": "a disk that is full",
    "RS806": "a file operation that the operating system refuses",
    "RS807": "a configuration file that is not valid TOML",
    "RS808": "an unknown key in a configuration file",
    "RS809": "a value that a key of a configuration file cannot have",
    "RS810": "a missing key in a configuration file",
    "RS811": "a directory without anything to read",
    "RS812": "a file that somebody changed while rebsync was about to write it",
    "RS813": "a link that is not followed",
    "RS814": "a pipe, a device or the like where a file is wanted",
    "RS815": "a path that leads out of what it belongs to",
    "RS816": "a part of rebsync that is not installed",
    "RS820": "a folder for the cache that is not used, as others could have written to it",
    "RS830": "a number of more digits than rebsync reads",
}

PROPERTIES = {
    "RS901": "a name in a property that stands for nothing",
    "RS902": "a state variable that the class of a rebec does not have",
    "RS903": "a part of a property that is of the wrong type",
    "RS904": "a definition that depends on itself",
    "RS905": "a definition or property that is given twice",
    "RS906": "an operator that does not belong in this section",
    "RS907": "a temporal operator with the wrong operands",
    "RS908": "an expression that cannot stand in a property",
    "RS909": "an index that the array does not have",
    "RS910": "a definition that is never used",
    "RS911": "a property file without its model",
}

QUESTIONS = {
    "RS912": "a question that is not understood",
    "RS913": "a topic, field or constant in a question that the package does not have",
    "RS914": "a topic in a question or an environment that is one of several",
    "RS915": "a topic or field of an environment that the package does not have",
    "RS916": "a part of an environment that does not fit the package",
}

EXTRACTION = {
    "RS941": "a place of the code that the model lacks",
    "RS942": "a place of the code of which the model allows more than it does",
    "RS943": "code in which no class of a model was found",
    "RS944": "a file of code that no program of the package is made of: it is not read",
    "RS945": "an accepted finding that is not there as it was",
    "RS946": "a place where there is nothing that may be accepted",
    "RS947": "a place of which the model says what the code does only under an assumption",
    "RS949": "something that a verification of what the code does rests on, or leaves open",
}

STEP = {
    "RS950": "records in `.rebsync/` that this rebsync would not have written",
    "RS951": "a change of the model that the code does not have",
    "RS952": "a change of the code that the model does not have",
    "RS953": "an element that model and code have changed differently",
    "RS954": "a difference of model and code of which it is not known who moved",
    "RS955": "a setting that is another than when the code was generated",
    "RS956": "generated code that no model describes, and that was edited",
    "RS957": "something that goes wrong in what the code does",
    "RS958": "a verification of what the code does that has no answer",
    "RS959": "an element that the code has changed, and that could not be read in whole",
    "RS960": "a path without a package that was made from a model",
    "RS961": "a package without the manifest of `.rebsync/`",
    "RS962": "a manifest that is damaged",
    "RS963": "a manifest of a newer rebsync",
    "RS964": "a package without the model as of the last time in step",
    "RS965": "a package whose model is not where it was, or not of that name",
    "RS966": "a conflict that a merge left in a file",
    "RS967": "changes of model and code that make no model together",
    "RS968": "merged code that does not say what the merged model says",
    "RS969": "a generated file that is edited or gone, and cannot be merged",
}

DIFFERENCES = {
    "RS970": "a body that the code writes otherwise than the model, and that does the same",
    "RS971": "an element that only the second of two models has",
    "RS972": "an element that only the first of two models has",
    "RS973": "an element that has another name in the second of two models",
    "RS974": "an element or a statement that is elsewhere in the second of two models",
    "RS975": "a statement that only the second of two models has",
    "RS976": "a statement that only the first of two models has",
    "RS977": "a part of an element or a statement that is different in two models",
    "RS978": "a place of which it is not known whether two models differ there",
    "RS979": "a run that only one of two models has",
}

RUNS = {
    "RS921": "a text that is not JSON where a run is wanted",
    "RS922": "a part of a run that is missing or of the wrong kind",
    "RS923": "a text that holds no run, or not the one that is wanted",
    "RS924": "a run that the model does not have",
    "RS925": "a state space that is too large to draw",
    "RS926": "something of Timed Rebeca in a model that is checked as core Rebeca",
    "RS927": "an array, or the state of a rebec, that is too large to check",
    "RS928": "a constant that the model does not have, or not with one value",
    "RS929": "a name that no property has",
    "RS931": "no C compiler for the compiled engine, or one that fails",
    "RS932": "a model without the symmetries that are to reduce its states",
    "RS933": "no cluster that can search: Ray is missing, nobody answers, or too few processors",
    "RS934": "something that a cluster does not decide",
}

CONFORMANCE = {
    "RS980": "a step that was recorded and that no run of the model has",
    "RS981": "a bag, and no rosbags to read it with",
    "RS982": "a recording that cannot be read, or no recording",
    "RS983": "a message of a recording whose fields are not those of the model",
    "RS984": "a recorded run of which it is not known whether the model has it",
    "RS985": "a recording with the nodes of several namespaces",
    "RS986": "a recorded run in which a rule of the model is broken",
    "RS987": "a property that a recorded run violates",
}

GRAPH = {
    "RS990": "a topic, service or action whose ends have different types",
    "RS991": "a subscription that asks more of a quality of service than a publisher offers",
    "RS992": "a topic to which nothing of what was read publishes",
    "RS993": "a topic to which nothing of what was read subscribes",
    "RS994": "two names of the computation graph that differ by a slip",
    "RS995": "a remapping of a name that its node does not use",
    "RS996": "a parameter that is set and that its node does not have",
    "RS997": "a service or action that nothing of what was read offers",
    "RS998": "a service or action that nothing of what was read calls",
}

CODES: dict[str, str] = {
    **SYNTAX,
    **NAMES,
    **TYPES,
    **STRUCTURE,
    **WARNINGS,
    **ROBOTIC,
    **GENERATION,
    **FILES,
    **PROPERTIES,
    **QUESTIONS,
    **RUNS,
    **EXTRACTION,
    **DIFFERENCES,
    **STEP,
    **CONFORMANCE,
    **GRAPH,
}
