import "./style.css"; import * as T from "three"; import Dygraph from "dygraphs"; window.T=T; window.D=Dygraph
